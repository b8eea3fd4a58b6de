// The results of a benchmark run for people, as they come in.
#pragma once

#include <string>

#include "bench/circumstances.hpp"
#include "bench/copies.hpp"
#include "bench/sweep.hpp"
#include "bench/tune.hpp"

namespace geodisk::bench {

/// All print to standard output and flush it.
void print_heading(const Circumstances& circumstances);
void print_row(const Measurement& row);
/// The exponents of a sweep, if it is one.
void print_growth(const Series& series);

void print_copies_heading(const Circumstances& circumstances);
void print_copies(const CopiesRow& row);

void print_tune_heading(const Circumstances& circumstances);
void print_trial(const Trial& trial);
/// The tuning found and the file that keeps it.
void print_tuning(const Tuning& tuning, const std::string& path);

} // namespace geodisk::bench
