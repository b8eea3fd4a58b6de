// The plots of a scaling run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/circumstances.hpp"
#include "bench/measurement.hpp"

namespace geodisk::bench {

/// What follows the prefix in the names of the plots' files.
inline constexpr const char* kPlotEndings[] = {"-time-n.svg", "-time-faces.svg", "-memory-n.svg"};

/// The texts of these files, in the same order.
std::vector<std::string> plot_texts(const Circumstances& circumstances,
                                    const std::vector<Series>& series);

} // namespace geodisk::bench
