#include "baselines/count_calls.hpp"

#include <algorithm>
#include <cstdint>

namespace geodisk::ref {

std::vector<std::uint32_t> count_calls(std::span<const std::vector<std::uint32_t>> above,
                                       std::span<const std::uint8_t> accepted) {
    std::vector<std::uint32_t> calls(above.size(), 1);
    for (std::size_t i = 0; i < above.size(); ++i) {
        for (const std::uint32_t other : above[i]) {
            calls[i] = std::min(calls[i] + calls[other], kMaxCalls);
            if (accepted[other] != 0) {
                break;
            }
        }
    }
    return calls;
}

void add_calls(CallHistogram& histogram, std::span<const std::uint32_t> calls_each) {
    for (const std::uint32_t calls : calls_each) {
        ++histogram.candidates[std::min<std::size_t>(calls, histogram.candidates.size()) - 1];
        histogram.calls += calls;
    }
}

} // namespace geodisk::ref
