#include "parts/ranges/ranged_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/connectivity.hpp"
#include "mesh/radius_pieces.hpp"
#include "parts/reach.hpp"

namespace geodisk {
namespace {

constexpr double kCubesPerDiagonal = 16;
// Far from the origin a point may be rounded into the next cube, by less than this part of one.
constexpr double kNextCube = 0x1p-20;

/// Returns a lower bound on the distance between points in two cubes, in sides.
double gap_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double gap = std::max(0.0, std::abs(a[axis] - b[axis]) - 1 - kNextCube);
        square += gap * gap;
    }
    return std::sqrt(square);
}

/// Returns false for a face that is ignored. Its corners may be anywhere.
bool counts(const FacePlaces& places, std::size_t face) {
    const std::uint32_t* const corners = &places.triangles[3 * face];
    return takes_part({corners[0], corners[1], corners[2]});
}

template <class Visit>
void for_each_in(const std::array<double, 3>& low, const std::array<double, 3>& high,
                 const Visit& visit) {
    for (double x = low[0]; x <= high[0]; ++x) {
        for (double y = low[1]; y <= high[1]; ++y) {
            for (double z = low[2]; z <= high[2]; ++z) {
                visit(std::array{x, y, z});
            }
        }
    }
}

} // namespace

RangedReach::RangedReach(Talk& talk, const KnownSurface& known, double min_distance)
    : side_(known.statistics.diagonal / kCubesPerDiagonal), min_distance_(min_distance) {
    if (known.fields.radii() == nullptr) {
        return;
    }
    struct Told {
        Cube cube;
        float radius;
    };
    std::vector<Told> own;
    for (const auto& [cube, radius] : radii_of(places_and_radii_of(talk, known, known.faces))) {
        own.push_back({cube, radius});
    }
    for (const auto& others : talk.all_to_all(ByProcess<Told>(talk.size(), own))) {
        for (const Told& other : others) {
            float& radius = radii_[other.cube];
            radius = std::max(radius, other.radius);
        }
    }
    double most = own.empty() ? 1 : 0;
    for (const Told& told : own) {
        most = std::max(most, in_cube(told.cube));
    }
    on_own_ = most;
}

double RangedReach::on_face(const FacePlaces& places, std::size_t face) {
    if (radii_.empty() || !counts(places, face)) {
        return 1;
    }
    double most = 0;
    const Box box = box_of(places, 3 * face, 3 * face + 3);
    for_each_in(box.low, box.high, [&](const Cube& cube) {
        most = radii_.contains(cube) ? std::max(most, in_cube(cube)) : most;
    });
    return most;
}

double RangedReach::in_cube(const Cube& cube) {
    const auto [bound, is_new] = bounds_.try_emplace(cube, 0.0);
    if (is_new) {
        const double step = kReachSlope * side_ / min_distance_;
        double raised = 0;
        for (const auto& [other, radius] : radii_) {
            raised =
                std::max(raised, static_cast<double>(radius) - step * gap_between(cube, other));
        }
        bound->second = reach_of(raised);
    }
    return bound->second;
}

RangedReach::Box RangedReach::box_of(const FacePlaces& places, std::size_t first_corner,
                                     std::size_t end) const {
    Box box;
    box.low.fill(std::numeric_limits<double>::infinity());
    box.high.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t corner = first_corner; corner < end; ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t at = std::size_t{3} * places.triangles[corner] + axis;
            const double number = std::floor(places.positions[at] / side_);
            box.low[axis] = std::min(box.low[axis], number);
            box.high[axis] = std::max(box.high[axis], number);
        }
    }
    return box;
}

/// Returns the cubes that faces touch, with the largest radius in each.
std::map<RangedReach::Cube, float> RangedReach::radii_of(const FacePlaces& places) const {
    const RadiusField field = RadiusPieces::factors_on(places.triangles, places.radii);
    std::map<Cube, float> radii;
    for (std::size_t corner = 0; corner < places.triangles.size(); corner += 3) {
        if (!counts(places, corner / 3)) {
            continue;
        }
        const auto factors = field.factors().subspan(corner, 3);
        const float largest = 0.5f * std::max({factors[0], factors[1], factors[2]});
        const Box box = box_of(places, corner, corner + 3);
        for_each_in(box.low, box.high, [&](const Cube& cube) {
            float& radius = radii[cube];
            radius = std::max(radius, largest);
        });
    }
    return radii;
}

} // namespace geodisk
