#include "engine/job/order_cut.hpp"

#include <algorithm>

namespace geodisk {
namespace {

// Orders are spread evenly, so a few guesses by proportion do; halves where they do not.
constexpr std::uint32_t kMaxByProportion = 16;

} // namespace

OrderCut::OrderCut(std::uint32_t end, std::uint32_t drawn, std::uint32_t wanted)
    : wanted_(wanted), high_(end), high_count_(drawn) {
    choose();
}

void OrderCut::note(std::uint32_t below) {
    if (below < wanted_) {
        low_ = guess_;
        low_count_ = below;
    } else {
        high_ = guess_;
        high_count_ = below;
    }
    choose();
}

void OrderCut::choose() {
    is_found_ = high_count_ == wanted_ || high_ - low_ <= 1;
    if (is_found_) {
        return;
    }
    const double part = guesses_ < kMaxByProportion
                            ? static_cast<double>(wanted_ - low_count_) / (high_count_ - low_count_)
                            : 0.5;
    const auto step = static_cast<std::uint32_t>(part * (high_ - low_));
    guess_ = low_ + std::clamp(step, 1u, high_ - low_ - 1);
    ++guesses_;
}

} // namespace geodisk
