#include "kernels/resolve.hpp"

#include "constants.h"

namespace geodisk::ref {

void resolve_batch(std::span<const std::uint32_t> ranks,
                   std::span<const std::vector<std::uint32_t>> conflicts,
                   std::span<std::uint8_t> states) {
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        if (states[ranks[i]] == gpu::kRejected) {
            continue;
        }
        states[ranks[i]] = gpu::kAccepted;
        for (const std::uint32_t other : conflicts[i]) {
            states[other] = gpu::kRejected;
        }
    }
}

} // namespace geodisk::ref
