/// @file
/// The interface of Honeyguide for programs: restrictions, bases, QFunctions and operators evaluated without a matrix.
/// Names, signatures and values are those of libCEED; see docs/ for what the two share and where they differ.
#ifndef CEED_H
#define CEED_H

#include "ceed/ceed.h"

#endif
