// The results of a benchmark run for people, as they come in.
#pragma once

#include "bench/circumstances.hpp"
#include "bench/measurement.hpp"

namespace geodisk::bench {

/// All print to standard output and flush it.
void print_heading(const Circumstances& circumstances);
void print_row(const Measurement& row);
/// The exponents of a sweep, if it is one.
void print_growth(const Series& series);

} // namespace geodisk::bench
