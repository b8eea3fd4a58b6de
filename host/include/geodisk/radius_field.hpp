// RadiusField: radii that vary over a surface (paper section 5.8).
// Stable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

struct VertexRadii;

/// Factor g of the radius at a point: r(p) = g(p) * r_max, with r_max half of
/// `SampleParams::min_distance`. Two samples p and q are at least r(p) + r(q) apart. g is linear in
/// each triangle, or made from a density that is. Vertices that the mesh joined have the mean of
/// their values.
///
/// Immutable and independent of the sampling distance: one object may serve many runs and threads.
class RadiusField {
  public:
    /// Minimum of g. Radii may differ by a factor of 1,000, densities by 1,000,000.
    static constexpr double kMinFactor = 0.001;

    /// Makes a field from one g per vertex of the mesh, in its order. Candidates are as dense as
    /// 1 / g^2. Ignores values of unused vertices. Keeps values as floats. Takes time linear in the
    /// mesh.
    ///
    /// Errors: `invalid_argument` unless there is one value per vertex, and for a value outside
    /// kMinFactor to 1, with the vertex in `Error::element`; `out_of_host_memory`.
    GEODISK_API static Result<RadiusField> prepare(const PreparedMesh& mesh,
                                                   std::span<const double> factors) noexcept;

    /// Makes a field from one density per vertex, in any unit, linear in each triangle. Samples per
    /// area are proportional to it; none where it is 0. Ignores values of unused vertices. Takes
    /// time linear in the mesh.
    ///
    /// Radii differ by a factor of up to 32, and of up to 4 within a triangle. Where the density
    /// asks for more, samples are spread by chance instead, at the same density.
    ///
    /// Errors: `invalid_argument` unless there is one value per vertex, if no triangle has a
    /// density above 0, and for a value that is negative or not finite, with the vertex in
    /// `Error::element`; `out_of_host_memory`.
    GEODISK_API static Result<RadiusField> from_density(const PreparedMesh& mesh,
                                                        std::span<const double> density) noexcept;

    /// Returns the field on a part of its mesh: face i of `part` is face `faces[i]` here.
    GEODISK_API RadiusField on_part(const PreparedMesh& part,
                                    std::span<const std::uint32_t> faces) const;

    /// Returns the field as bytes for load(), 28 to 40 per face. Errors: `out_of_host_memory`.
    GEODISK_API Result<std::vector<std::byte>> save() const noexcept;

    /// Returns the field that save() wrote, on the same mesh or an equal one. Errors:
    /// `invalid_argument` for bytes of something else, of another version or byte order, or with
    /// values out of range or at odds with each other, but for the area; `out_of_host_memory`.
    GEODISK_API static Result<RadiusField> load(std::span<const std::byte> bytes) noexcept;

    /// Returns g at the origin of each half-edge, three per face.
    std::span<const float> factors() const noexcept { return factors_; }
    std::uint32_t face_count() const noexcept {
        return static_cast<std::uint32_t>(factors_.size() / 3);
    }
    /// Returns g at the point of a face with these weights of its corners.
    GEODISK_API double factor_at(std::uint32_t face, const float (&weights)[3]) const noexcept;

    /// Returns the minimum of g. min_distance times this is the minimum distance of all samples.
    double min_factor() const noexcept { return static_cast<double>(min_factor_); }

    /// Returns the area of a surface that takes as many samples with the largest radius everywhere:
    /// the integral of 1 / g^2, or of the density in units of that at r_max.
    double effective_area() const noexcept { return effective_area_; }
    /// Returns the mean over a face of what effective_area() integrates.
    GEODISK_API double samples_in(std::uint32_t face) const noexcept;

    /// Return the density of candidates in each face, relative to that at r_max, and its maximum:
    /// the mean of 1 / g^2, or less where candidates are thinned to a density.
    std::span<const float> densities() const noexcept { return densities_; }
    float largest_density() const noexcept { return largest_density_; }

    /// Returns the values that propose candidates in a face, see shaders/lib/candidate.glsl:
    /// g^(2/3) at the origin of each half-edge, or the density.
    std::span<const float> spreads() const noexcept { return spreads_; }

    /// Returns 1 / g^2 at the origin of each half-edge, linear in faces, of a field from a density.
    /// Empty for factors.
    std::span<const float> packing() const noexcept { return packing_; }

    /// Returns the share of samples at the origin of a half-edge, of those that fit with these
    /// radii: 1, or less where candidates are thinned.
    GEODISK_API double share_at(std::size_t half_edge) const noexcept;

    /// Returns a bound per face on how far disks reach into it, in units of `min_distance`: no path
    /// of length l from a point of the face leads to a point q with r(q) > l + bound. A disk of
    /// radius r need not enter a face at a distance above r + bound.
    ///
    /// If g changes by less than the distance, the bound is the face's largest radius. `mesh` is
    /// that of prepare(). Errors: `out_of_host_memory`.
    GEODISK_API Result<std::vector<float>> reach_bounds(const PreparedMesh& mesh,
                                                        double min_distance) const noexcept;

    /// Returns the density at which radii are largest, of a field from a density. An edit that
    /// changes it changes all radii. 0 for factors.
    double min_density() const noexcept { return min_density_; }

  private:
    friend struct RadiusPieces; // Makes radii of surfaces of which no process holds the whole.

    static RadiusField on_mesh(const PreparedMesh& mesh, const VertexRadii& radii);
    void find_min_factor();

    std::vector<float> factors_;
    std::vector<float> spreads_;
    std::vector<float> packing_;
    std::vector<float> densities_;
    float largest_density_ = 0;
    float min_factor_ = 1;
    double effective_area_ = 0;
    double min_density_ = 0;
};

} // namespace geodisk
