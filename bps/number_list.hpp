/// @file
/// Lists of numbers on a command line.
#pragma once

#include <ceed.h>

#include <string>
#include <vector>

namespace hg::bps {

/// The parts of a comma-separated text.
std::vector<std::string> split(const std::string &text);

/// `1,2,3`, `1-8`, `1-3,6` as numbers, each in [low, high]. Throws Error that names the option and the bad part.
std::vector<CeedInt> parse_integers(const std::string &option, const std::string &text, CeedInt low, CeedInt high);

/// `1e4,100000` as numbers, each in [low, high]. Throws Error that names the option and the bad part.
std::vector<double> parse_reals(const std::string &option, const std::string &text, double low, double high);

}  // namespace hg::bps
