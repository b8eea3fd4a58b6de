#include "parts/ranges/nearest_place.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geodisk {
namespace {

constexpr std::size_t kAxes = 3;

} // namespace

NearestPlace::NearestPlace(std::vector<Place> places) : places_(std::move(places)) {
    sort(0, places_.size(), 0);
}

void NearestPlace::sort(std::size_t begin, std::size_t end, std::size_t axis) {
    if (end - begin < 2) {
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = places_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                     first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end),
                     [axis](const Place& a, const Place& b) { return a[axis] < b[axis]; });
    sort(begin, middle, (axis + 1) % kAxes);
    sort(middle + 1, end, (axis + 1) % kAxes);
}

double NearestPlace::distance(const Place& from, double most) const {
    search(0, places_.size(), 0, from, most);
    return most;
}

void NearestPlace::search(std::size_t begin, std::size_t end, std::size_t axis, const Place& from,
                          double& least) const {
    if (begin == end) {
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const Place& place = places_[middle];
    least = std::min(least, std::hypot(place[0] - from[0], place[1] - from[1], place[2] - from[2]));
    const double beyond = from[axis] - place[axis];
    const std::size_t next = (axis + 1) % kAxes;
    const auto search_side = [&](bool is_above) {
        is_above ? search(middle + 1, end, next, from, least)
                 : search(begin, middle, next, from, least);
    };
    search_side(beyond > 0);
    if (std::abs(beyond) < least) {
        search_side(!(beyond > 0));
    }
}

} // namespace geodisk
