#include "baselines/space_disks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace geodisk::ref {
namespace {

using Vector = glm::dvec3;

Vector unit(const Vector& v, const Vector& otherwise) {
    const double size = length(v);
    return size > 0 ? v / size : otherwise;
}

/// Returns the corners of face f.
std::array<Vector, 3> corners_of(const MeshView& mesh, std::uint32_t f) {
    std::array<Vector, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangles[std::size_t{3} * f + k];
        corners[k] = {mesh.coordinate(v, 0), mesh.coordinate(v, 1), mesh.coordinate(v, 2)};
    }
    return corners;
}

/// Returns the normal of a face; its length is twice the area.
Vector face_normal(const std::array<Vector, 3>& corners) {
    return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

/// Returns the bounding box, moved to the origin. A flat one gets some thickness.
Box bounds(std::span<const OrientedPoint> points, double thickness, Vector& corner) {
    constexpr double kFarther = 1 + 1e-9; // So that the farthest points lie inside.
    corner = Vector(std::numeric_limits<double>::infinity());
    Vector most = -corner;
    for (const OrientedPoint& point : points) {
        corner = min(corner, point.position);
        most = max(most, point.position);
    }
    const Vector size = max((most - corner) * kFarther, thickness);
    Box box;
    box.sides = {size.x, size.y, size.z};
    return box;
}

} // namespace

double straight_length(const OrientedPoint& a, const OrientedPoint& b) {
    return distance(a.position, b.position);
}

double curve_length(const OrientedPoint& a, const OrientedPoint& b) {
    // Below it the quotient is less accurate than its limit.
    constexpr double kSameAngle = 1e-6;
    const Vector way = b.position - a.position;
    const double straight = straight_length(a, b);
    if (straight == 0) {
        return 0;
    }
    const double from = std::clamp(dot(a.normal, way) / straight, -1.0, 1.0);
    const double to = std::clamp(dot(b.normal, way) / straight, -1.0, 1.0);
    if (std::abs(from - to) < kSameAngle) {
        const double middle = 0.5 * (from + to);
        return straight / std::sqrt(std::max(1 - middle * middle, 1e-12));
    }
    return straight * (std::asin(from) - std::asin(to)) / (from - to);
}

std::vector<OrientedPoint> oriented_points(const MeshView& mesh,
                                           std::span<const FacePoint<double>> points) {
    std::vector<Vector> normals(mesh.vertex_count(), Vector());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            normals[mesh.triangles[std::size_t{3} * f + k]] += face_normal(corners_of(mesh, f));
        }
    }
    std::vector<OrientedPoint> result;
    result.reserve(points.size());
    for (const FacePoint<double>& point : points) {
        const std::array<Vector, 3> corners = corners_of(mesh, point.face);
        const Vector flat = unit(face_normal(corners), {0, 0, 1});
        const double weights[3] = {1 - point.weight1 - point.weight2, point.weight1, point.weight2};
        Vector position;
        Vector normal;
        for (std::size_t k = 0; k < 3; ++k) {
            position += weights[k] * corners[k];
            normal +=
                weights[k] * unit(normals[mesh.triangles[std::size_t{3} * point.face + k]], flat);
        }
        result.push_back({position, unit(normal, flat)});
    }
    return result;
}

SpaceDisks::SpaceDisks(std::span<const OrientedPoint> by_rank, double min_distance, Length length)
    : min_distance_(min_distance), length_(length),
      cells_(bounds(by_rank, min_distance, corner_), min_distance),
      starts_(std::size_t{cells_.count()} + 1, 0), ranks_(by_rank.size()), places_(by_rank.size()) {
    for (const OrientedPoint& point : by_rank) {
        ++starts_[std::size_t{cells_.cell_of(in_box(point))} + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    std::vector<std::uint32_t> cursor(starts_.begin(), starts_.end() - 1);
    points_.resize(by_rank.size());
    for (std::uint32_t rank = 0; rank < by_rank.size(); ++rank) {
        const std::uint32_t place = cursor[cells_.cell_of(in_box(by_rank[rank]))]++;
        ranks_[place] = rank;
        points_[place] = by_rank[rank];
        places_[rank] = place;
    }
}

std::array<double, 3> SpaceDisks::in_box(const OrientedPoint& point) const {
    const Vector place = point.position - corner_;
    return {place.x, place.y, place.z};
}

void SpaceDisks::find(std::uint32_t center, std::span<const std::uint8_t> wanted,
                      std::vector<std::uint32_t>& found) {
    found.clear();
    const OrientedPoint& from = points_[places_[center]];
    cells_.for_around(in_box(from), [&](std::uint32_t cell) {
        for (std::uint32_t place = starts_[cell]; place < starts_[std::size_t{cell} + 1]; ++place) {
            const std::uint32_t rank = ranks_[place];
            if (!wanted[rank] || rank == center) {
                continue;
            }
            const OrientedPoint& to = points_[place];
            const Vector way = to.position - from.position;
            if (dot(way, way) < min_distance_ * min_distance_ &&
                length_(from, to) < min_distance_) {
                found.push_back(rank);
            }
        }
        return true;
    });
}

} // namespace geodisk::ref
