#include "baselines/box.hpp"

#include <algorithm>
#include <cmath>

namespace geodisk::ref {

double Box::volume() const {
    double volume = 1;
    for (const double side : sides) {
        volume *= side;
    }
    return volume;
}

double Box::distance2(std::span<const double> a, std::span<const double> b) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < sides.size(); ++axis) {
        double d = std::abs(a[axis] - b[axis]);
        d = is_periodic ? std::min(d, sides[axis] - d) : d;
        sum += d * d;
    }
    return sum;
}

BoxCells::BoxCells(const Box& box, double reach)
    : is_periodic_(box.is_periodic), axes_(box.sides.size()) {
    const double most = std::floor(std::pow(0x1p24, 1.0 / static_cast<double>(axes_)) + 1e-6);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        const double fitting = std::clamp(std::floor(box.sides[axis] / reach), 1.0, most);
        counts_[axis] = static_cast<std::uint32_t>(fitting);
        per_length_[axis] = fitting / box.sides[axis];
        count_ *= counts_[axis];
    }
}

std::uint32_t BoxCells::place_on(std::size_t axis, double x) const {
    return std::min(static_cast<std::uint32_t>(x * per_length_[axis]), counts_[axis] - 1);
}

std::uint32_t BoxCells::cell_of(std::span<const double> point) const {
    std::uint32_t cell = 0;
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        cell = cell * counts_[axis] + place_on(axis, point[axis]);
    }
    return cell;
}

BoxCells::Places BoxCells::places_around(std::size_t axis, double x) const {
    const std::uint32_t count = counts_[axis];
    const std::uint32_t place = place_on(axis, x);
    Places places;
    const auto add = [&places](std::uint32_t at) { places.at[places.count++] = at; };
    add(place);
    if (place > 0) {
        add(place - 1);
    } else if (is_periodic_ && count > 2) {
        add(count - 1);
    }
    if (place + 1 < count) {
        add(place + 1);
    } else if (is_periodic_ && count > 2) {
        add(0);
    }
    return places;
}

BoxGrid::BoxGrid(const Box& box, double distance)
    : box_(box), distance2_(distance * distance), cells_(box, distance),
      first_(cells_.count(), kNone) {}

void BoxGrid::add(std::span<const double> point) {
    std::uint32_t& first = first_[cells_.cell_of(point)];
    next_.push_back(first);
    first = size() - 1;
    coordinates_.insert(coordinates_.end(), point.begin(), point.end());
}

bool BoxGrid::is_free(std::span<const double> at) const {
    bool is_free = true;
    for_near(at, [&is_free](std::uint32_t) { return is_free = false; });
    return is_free;
}

std::vector<double> throw_in_order(const Box& box, double min_distance,
                                   std::span<const double> pool) {
    BoxGrid samples(box, min_distance);
    for (std::size_t at = 0; at < pool.size(); at += box.dimension()) {
        const auto dart = pool.subspan(at, box.dimension());
        if (samples.is_free(dart)) {
            samples.add(dart);
        }
    }
    return samples.coordinates();
}

} // namespace geodisk::ref
