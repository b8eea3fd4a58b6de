// Twin of shaders/kernels/find_idle.comp and select.comp: the lowest-ranked idle candidates (paper
// section 4.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::ref {

/// Up to `slots` idle ranks from `first` on, ascending. `states` holds a gpu::k* state per rank.
std::vector<std::uint32_t> select_idle(std::span<const std::uint8_t> states, std::uint32_t first,
                                       std::uint32_t slots);

} // namespace geodisk::ref
