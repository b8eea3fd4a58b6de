#include "kernels/select.hpp"

#include "constants.h"

namespace geodisk::ref {

std::vector<std::uint32_t> select_idle(std::span<const std::uint8_t> states, std::uint32_t first,
                                       std::uint32_t slots) {
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t rank = first; rank < states.size() && ranks.size() < slots; ++rank) {
        if (states[rank] == gpu::kIdle) {
            ranks.push_back(rank);
        }
    }
    return ranks;
}

} // namespace geodisk::ref
