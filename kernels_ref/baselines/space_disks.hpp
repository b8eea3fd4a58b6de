// Disks for metrics of points and normals in space, with cells: the straight line, and the closed
// form that approximates geodesic distance (Bowers, Wang, Wei and Maletz 2010). The paper compares
// with these in sections 5.2, 5.6 and 6.1.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "baselines/box.hpp"
#include "baselines/disk_query.hpp"
#include "geodisk/mesh.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// A point of a surface in space, with its unit normal.
struct OrientedPoint {
    glm::dvec3 position, normal;
};

/// Returns the length of the straight line, without normals.
double straight_length(const OrientedPoint& a, const OrientedPoint& b);

/// Returns the length of a curve between two points whose normals turn evenly: exact on planes and
/// spheres, never shorter than the straight line.
double curve_length(const OrientedPoint& a, const OrientedPoint& b);

/// Returns positions and smoothly interpolated normals of points on a mesh in space.
std::vector<OrientedPoint> oriented_points(const MeshView& mesh,
                                           std::span<const FacePoint<double>> points);

class SpaceDisks : public DiskQuery {
  public:
    /// A metric that is never shorter than the straight line.
    using Length = double (*)(const OrientedPoint& a, const OrientedPoint& b);

    SpaceDisks(std::span<const OrientedPoint> by_rank, double min_distance, Length length);

    std::uint32_t size() const override { return static_cast<std::uint32_t>(places_.size()); }
    void find(std::uint32_t center, std::span<const std::uint8_t> wanted,
              std::vector<std::uint32_t>& found) override;

  private:
    std::array<double, 3> in_box(const OrientedPoint& point) const;

    double min_distance_;
    Length length_;
    glm::dvec3 corner_; ///< Corner of the bounding box.
    BoxCells cells_;
    std::vector<std::uint32_t> starts_; ///< First index of each cell, and the end.
    std::vector<std::uint32_t> ranks_;  ///< Ranks by cell.
    std::vector<OrientedPoint> points_; ///< Points in the order of `ranks_`.
    std::vector<std::uint32_t> places_; ///< Places by rank.
};

} // namespace geodisk::ref
