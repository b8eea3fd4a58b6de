// The files that a benchmark run writes.
#pragma once

#include <vector>

#include "bench/circumstances.hpp"
#include "bench/options.hpp"
#include "bench/sweep.hpp"

namespace geodisk::bench {

/// Finds out before the work that it would be in vain. Throws UserError: `bad_output` if a file
/// cannot be written, `usage` if it would replace a mesh or another one.
void check_outputs(const Options& options);

/// Writes all files that `options` name, or none. Throws UserError(bad_output).
void write_outputs(const Options& options, const Circumstances& circumstances,
                   const std::vector<Series>& series);

} // namespace geodisk::bench
