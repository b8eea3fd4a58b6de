// Radii that vary over the surface (paper section 5.8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// The factor g by which the radius at a point is smaller than the largest one: r(p) = g(p) * r_max
/// with r_max half of `SampleParams::min_distance`. Two samples p and q are at least r(p) + r(q)
/// apart. g is linear in each triangle.
///
/// Immutable after `prepare` and independent of the sampling distance, so one object may serve many
/// runs and threads.
class RadiusField {
  public:
    /// Radii may differ by a factor of a thousand, so numbers of samples per area by a million.
    static constexpr double kLeastFactor = 0.001;

    /// Takes g for every vertex of the mesh, in its order, and readies the drawing of candidates,
    /// which are as dense as 1 / g^2. What unused vertices have does not matter. Values are kept as
    /// floats. Linear in the mesh.
    ///
    /// Fails with `invalid_argument` when there is not one value per vertex, or with the vertex in
    /// `Error::element` when one is not from kLeastFactor to 1; with `out_of_host_memory`.
    GEODISK_API static Result<RadiusField> prepare(const PreparedMesh& mesh,
                                                   std::span<const double> factors) noexcept;

    /// g at the origin of each half-edge, three to a face.
    std::span<const float> factors() const noexcept { return factors_; }
    std::uint32_t face_count() const noexcept {
        return static_cast<std::uint32_t>(factors_.size() / 3);
    }
    /// g at the point of a face with these weights of its corners.
    GEODISK_API double factor_at(std::uint32_t face, const float (&weights)[3]) const noexcept;

    /// The integral of 1 / g^2 over the surface: the area of one that takes as many samples with
    /// the largest radius everywhere.
    double effective_area() const noexcept { return effective_area_; }

    /// The mean of 1 / g^2 over each face, by which it has more candidates, and the largest.
    std::span<const float> densities() const noexcept { return densities_; }
    float largest_density() const noexcept { return largest_density_; }

    /// What proposes candidates in a face, see shaders/lib/candidate.glsl: g^(2/3) at the origin of
    /// each half-edge.
    std::span<const float> spreads() const noexcept { return spreads_; }

    /// How far disks reach into each face: from no point x of it a path of length l leads on to any
    /// point q with r(q) > l + bound. Lengths and bounds are in units of `min_distance`. A disk of
    /// radius r need not be followed through a face from where it is r + bound away.
    ///
    /// Where g changes by less than the way does, the bound is the face's largest radius.
    /// `mesh` is that of prepare(). Fails with `out_of_host_memory`.
    GEODISK_API Result<std::vector<float>> reach_bounds(const PreparedMesh& mesh,
                                                        double min_distance) const noexcept;

  private:
    std::vector<float> factors_;
    std::vector<float> spreads_;
    std::vector<float> densities_;
    float largest_density_ = 0;
    double effective_area_ = 0;
};

} // namespace geodisk
