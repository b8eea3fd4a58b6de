// Radii that vary over the surface (paper section 5.8).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// The factor g by which the radius at a point is smaller than the largest one: r(p) = g(p) * r_max
/// with r_max half of `SampleParams::min_distance`. Two samples p and q are at least r(p) + r(q)
/// apart. g is linear in each triangle, or made from a density that is.
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

    /// Takes how dense samples are to be at every vertex, in any unit: samples per area come out in
    /// proportion, more where it is more, and none where it is 0. It is linear in each triangle.
    /// Values of unused vertices are ignored. Linear in the mesh.
    ///
    /// Radii differ by a factor of up to 32, and by up to 4 within a triangle. Where the density
    /// asks for larger ones, samples are spread by chance instead, at the same density.
    ///
    /// Fails with `invalid_argument` when there is not one value per vertex, when no triangle has a
    /// density above 0, or with the vertex in `Error::element` when one is negative or not finite;
    /// with `out_of_host_memory`.
    GEODISK_API static Result<RadiusField> from_density(const PreparedMesh& mesh,
                                                        std::span<const double> density) noexcept;

    /// g at the origin of each half-edge, three to a face.
    std::span<const float> factors() const noexcept { return factors_; }
    std::uint32_t face_count() const noexcept {
        return static_cast<std::uint32_t>(factors_.size() / 3);
    }
    /// g at the point of a face with these weights of its corners.
    GEODISK_API double factor_at(std::uint32_t face, const float (&weights)[3]) const noexcept;

    /// The least g of all: min_distance times this is the least distance of two samples.
    GEODISK_API double least_factor() const noexcept;

    /// The integral of 1 / g^2 over the surface, or of the density in units of that at r_max: the
    /// area of one that takes as many samples with the largest radius everywhere.
    double effective_area() const noexcept { return effective_area_; }

    /// How much denser candidates are in the mean over each face, and the largest of these: the
    /// mean of 1 / g^2, or less where they are thinned to a density.
    std::span<const float> densities() const noexcept { return densities_; }
    float largest_density() const noexcept { return largest_density_; }

    /// What proposes candidates in a face, see shaders/lib/candidate.glsl: g^(2/3) at the origin of
    /// each half-edge, or the density.
    std::span<const float> spreads() const noexcept { return spreads_; }

    /// 1 / g^2 at the origin of each half-edge, which is linear in faces when it comes from a
    /// density; empty for factors.
    std::span<const float> packing() const noexcept { return packing_; }

    /// Samples at the origin of a half-edge, as a share of those that fit with these radii: 1, or
    /// less where candidates are thinned.
    GEODISK_API double share_at(std::size_t half_edge) const noexcept;

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
    std::vector<float> packing_;
    std::vector<float> densities_;
    float largest_density_ = 0;
    double effective_area_ = 0;
};

} // namespace geodisk
