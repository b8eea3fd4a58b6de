#include "coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace geodisk::ref {
namespace {

constexpr double kSlack = 0x1p-24;
// Disks are this much larger than what they cover, to measure gaps.
constexpr double kReach = 1.25;
// Gaps that are larger by less count as equal.
constexpr double kSameGap = 0x1p-10;
// Cells of uncovered points are split until they reach no farther, in units of the surface.
constexpr double kFinest = 0x1p-7;
// Cells that reach no farther are points.
constexpr double kPoint = 0x1p-40;

double length_of(double x, double y) {
    return std::sqrt(x * x + y * y);
}

FacePoint<double> middle(FacePoint<double> a, FacePoint<double> b) {
    return {a.face, (a.weight1 + b.weight1) / 2, (a.weight2 + b.weight2) / 2};
}

FacePoint<double> centroid(const std::array<FacePoint<double>, 3>& cell) {
    return {cell[0].face, (cell[0].weight1 + cell[1].weight1 + cell[2].weight1) / 3,
            (cell[0].weight2 + cell[1].weight2 + cell[2].weight2) / 3};
}

} // namespace

CoverageCheck::CoverageCheck(const Surface<double>& surface, std::vector<double> corner_radii,
                             double allowed)
    : surface_(surface), corner_radii_(std::move(corner_radii)), allowed_(allowed),
      largest_radius_(corner_radii_.empty() ? 0.5 : std::ranges::max(corner_radii_)),
      bins_(surface, {}), detector_(surface, bins_, double_tolerances(), 1) {}

void CoverageCheck::add_sample(FacePoint<double> center, double radius) {
    add(center, radius, false);
}

void CoverageCheck::add_avoided(FacePoint<double> center, double radius) {
    add(center, radius, true);
}

void CoverageCheck::add(FacePoint<double> center, double radius, bool keeps_out) {
    struct Recorder {
        std::vector<Light>& lights;
        double radius;
        bool keeps_out;

        void face(std::uint32_t h, double x, double y, double sigma) const {
            lights.push_back({h, true, keeps_out, x, y, 0, 0, sigma, radius});
        }
        void wedge(std::uint32_t h, double x, double y, double b0, double b1, double sigma) const {
            lights.push_back({h, false, keeps_out, x, -y, b0, b1, sigma, radius});
        }
    };
    detector_.set_limit(kReach * (keeps_out ? radius : radius + largest_radius_));
    detector_.spread(center, Recorder{lights_, radius, keeps_out});
}

void CoverageCheck::sort() {
    std::ranges::sort(lights_, {}, [](const Light& light) { return light.edge / 3; });
    starts_.assign(std::size_t{surface_.face_count()} + 1, lights_.size());
    for (std::size_t i = lights_.size(); i-- > 0;) {
        starts_[lights_[i].edge / 3] = i;
    }
    for (std::size_t face = surface_.face_count(); face-- > 0;) {
        starts_[face] = std::min(starts_[face], starts_[face + 1]);
    }
}

void CoverageCheck::test(std::uint32_t face) {
    stack_.clear();
    for (std::size_t i = starts_[face]; i < starts_[face + 1]; ++i) {
        stack_.push_back(static_cast<std::uint32_t>(i));
    }
    visit({{{face, 0, 0}, {face, 1, 0}, {face, 0, 1}}}, 0);
}

double CoverageCheck::radius_at(FacePoint<double> point) const {
    if (corner_radii_.empty()) {
        return 0.5;
    }
    const double* const radii = &corner_radii_[std::size_t{3} * point.face];
    return (1 - point.weight1 - point.weight2) * radii[0] + point.weight1 * radii[1] +
           point.weight2 * radii[2];
}

double CoverageCheck::limit_of(const Light& light, double radius) const {
    return light.keeps_out ? light.radius : light.radius + radius;
}

CoverageCheck::Measure CoverageCheck::measure(const Light& light, FacePoint<double> point) const {
    const auto at = position_in(surface_, light.edge, point);
    const double x = at.x - light.x, y = at.y - light.y;
    const double distance = length_of(x, y) + light.sigma;
    if (light.is_whole) {
        return {distance, 0};
    }
    const auto beyond = [&](double border, double sign) {
        const double along = border - light.x;
        const double across = sign * (x * -light.y - along * y);
        return across > 0 ? across / length_of(along, light.y) : 0;
    };
    return {distance, std::max(beyond(light.low - kSlack, -1), beyond(light.high + kSlack, 1))};
}

bool CoverageCheck::covers_corners(const Light& light, const Corners& cell,
                                   double min_radius) const {
    // The part that a light sees is convex, and so is the distance there.
    const double limit = allowed_ * limit_of(light, min_radius);
    return std::ranges::all_of(cell, [&](FacePoint<double> corner) {
        const auto [distance, aside] = measure(light, corner);
        return aside == 0 && distance < limit;
    });
}

double CoverageCheck::worth_a_look() const {
    return std::max(allowed_, result_.largest * (1 + kSameGap));
}

void CoverageCheck::note(FacePoint<double> point, double ratio) {
    if (ratio > result_.largest) {
        result_.largest = ratio;
        result_.uncovered = ratio < allowed_ ? std::nullopt : std::optional(point);
    }
}

void CoverageCheck::visit(const Corners& cell, std::size_t first) {
    ++result_.cells;
    const std::size_t end = stack_.size();
    const FacePoint<double> center = centroid(cell);
    const auto at = position_in(surface_, 3 * center.face, center);
    double reach = 0, min_radius = radius_at(center);
    for (const FacePoint<double>& corner : cell) {
        const auto p = position_in(surface_, 3 * center.face, corner);
        reach = std::max(reach, length_of(p.x - at.x, p.y - at.y));
        min_radius = std::min(min_radius, radius_at(corner));
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < end; ++i) {
        const Light& light = lights_[stack_[i]];
        const auto [distance, aside] = measure(light, center);
        const double limit = limit_of(light, radius_at(center));
        nearest = aside == 0 ? std::min(nearest, distance / limit) : nearest;
        const bool is_dead =
            aside == 0 && distance + reach < worth_a_look() * limit_of(light, min_radius);
        if (is_dead || covers_corners(light, cell, min_radius)) {
            stack_.resize(end);
            return;
        }
        const double farthest =
            kReach * (light.keeps_out ? light.radius : light.radius + largest_radius_);
        if (distance - reach < farthest && aside <= reach) {
            stack_.push_back(stack_[i]);
        }
    }
    if (nearest <= kReach) {
        note(center, nearest);
    }
    const bool is_open = stack_.size() == end;
    if (is_open || (nearest > kReach && reach <= kFinest)) {
        result_.is_beyond = true;
        note(center, std::max(result_.largest, kReach));
        result_.uncovered = result_.uncovered ? result_.uncovered : std::optional(center);
    } else if (reach <= (nearest < allowed_ ? kPoint : kFinest)) {
        note(center, std::max(nearest, allowed_));
    } else {
        const FacePoint<double> a = middle(cell[0], cell[1]), b = middle(cell[1], cell[2]),
                                c = middle(cell[2], cell[0]);
        for (const Corners& part : {Corners{cell[0], a, c}, Corners{a, cell[1], b},
                                    Corners{c, b, cell[2]}, Corners{a, b, c}}) {
            visit(part, end);
        }
    }
    stack_.resize(end);
}

} // namespace geodisk::ref
