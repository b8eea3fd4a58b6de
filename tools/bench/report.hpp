// The results of a benchmark run as files for programs.
#pragma once

#include <string>
#include <vector>

#include "bench/circumstances.hpp"
#include "bench/sweep.hpp"

namespace geodisk::bench {

/// One object with `circumstances`, `rows` and `growth`, and a line break. Each row names its
/// sweep; each entry of `growth` the sweep, the mesh, the quantity and the law fitted to its
/// seconds.
std::string json_text(const Circumstances& circumstances, const std::vector<Series>& series);

/// The circumstances as "# NAME: VALUE", a line of column names, and a line per row.
std::string csv_text(const Circumstances& circumstances, const std::vector<Series>& series);

} // namespace geodisk::bench
