#include "geodesics/window_list.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace geodisk::geodesics {
namespace {

bool begins_sooner(const Window& a, const Window& b) {
    return a.begin < b.begin;
}

} // namespace

void ListMerger::merge(WindowList& list, std::span<const Window> fresh) {
    all_.clear();
    std::ranges::merge(list, fresh, std::back_inserter(all_), begins_sooner);
    list.clear();
    for (std::size_t next = 0; next < all_.size(); ++next) {
        add(list, next);
    }
    if (!std::ranges::is_sorted(list, begins_sooner)) {
        std::ranges::sort(list, begins_sooner);
    }
}

/// Adds window `next` of all, or one that begins sooner since its begin was cut.
void ListMerger::add(WindowList& list, std::size_t next) {
    while (!list.empty() && all_[next].begin < list.back().end) {
        Window& window = all_[next];
        const double begin = window.begin;
        trim(list.back(), window);
        const bool is_last_gone = list.back().is_empty();
        if (is_last_gone) {
            list.pop_back();
        }
        if (window.is_empty()) {
            return;
        }
        if (window.begin == begin && !is_last_gone) {
            break;
        }
        for (std::size_t i = next; i + 1 < all_.size() && all_[i + 1].begin < all_[i].begin; ++i) {
            std::swap(all_[i], all_[i + 1]);
        }
    }
    list.push_back(all_[next]);
}

} // namespace geodisk::geodesics
