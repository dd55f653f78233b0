/// @file
/// Calls with a number for an enumeration: C++ has no such values, programs in C and in other languages do.
#ifndef HG_TEST_ENUMERATIONS_H
#define HG_TEST_ENUMERATIONS_H

#include <ceed/backend.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  CeedVector vec;                    ///< 6 entries
  CeedVector other;                  ///< 6 entries
  CeedElemRestriction rstr, points;  ///< L-vectors and E-vectors of up to 6 entries
  CeedBasis basis;
  CeedQFunction qf;
  CeedQFunctionContext ctx;
  Ceed ceed;
} EnumerationObjects;

/// A call in which one argument has the number `value`.
typedef struct {
  const char *name;
  int (*call)(EnumerationObjects *objects, int value);
} EnumerationCall;

/// All of them; the one after the last has a NULL name.
extern const EnumerationCall enumeration_calls[];

#ifdef __cplusplus
}
#endif

#endif
