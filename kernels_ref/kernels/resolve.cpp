#include "kernels/resolve.hpp"

namespace geodisk::ref {

void resolve_batch(std::span<const std::uint32_t> ranks,
                   std::span<const std::vector<std::uint32_t>> conflicts,
                   std::span<std::uint8_t> states) {
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        if (states[ranks[i]] == kRejected) {
            continue;
        }
        states[ranks[i]] = kAccepted;
        reject_all(conflicts[i], states);
    }
}

void reject_all(std::span<const std::uint32_t> conflicts, std::span<std::uint8_t> states) {
    for (const std::uint32_t other : conflicts) {
        states[other] = kRejected;
    }
}

} // namespace geodisk::ref
