// Features: the corners and curves of a surface, and the samples along them.
// Experimental.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// The features of a mesh. Curves are the edges where its faces meet at an angle, borders, and
/// edges of more than two faces. Corners are the vertices where a curve ends, where several meet,
/// and where one turns by more than 45 degrees.
class Features {
  public:
    /// Finds the features. Faces that meet at an edge turn by an angle of 0 where they are flat; an
    /// edge belongs to a curve if that is more than `degrees`. `mesh` was prepared from `view`.
    /// Errors: `invalid_argument` for degrees out of 1 to 180, and for a view of another mesh.
    GEODISK_API static Result<Features> find(const MeshView& view, const PreparedMesh& mesh,
                                             double degrees) noexcept;

    /// Returns the edges of all curves, each by the lowest of its half-edges.
    std::span<const std::uint32_t> edges() const noexcept { return edges_; }
    /// Returns the vertices that are corners, in ascending order.
    std::span<const std::uint32_t> corners() const noexcept { return corners_; }
    /// Returns the length of all curves.
    double length() const noexcept { return length_; }
    /// Returns PreparedMesh::identity() of the mesh.
    std::uint64_t mesh() const noexcept { return mesh_; }
    /// Returns true if a face at some feature takes samples.
    GEODISK_API bool are_sampled(const PreparedMesh& mesh, const SampleParams& params) const;

  private:
    std::vector<std::uint32_t> edges_, corners_;
    double length_ = 0;
    std::uint64_t mesh_ = 0;
};

/// Makes the domain of samples on features, to run before the surface: its candidates are the
/// corners, in their order, then darts at random places of the curves, many for each sample that
/// fits. They keep the distances of the surface, also from the existing samples of `params`. Give
/// the samples of the run as SampleParams::existing to the run of the surface, with the same
/// distance, radii, mask and points to avoid.
///
/// Corners closer to each other than the distance are dropped, but for the first ones. The pool
/// ratio has no effect. `mesh` and `params` as for Domain::surface().
///
/// Errors: those of Domain::surface(); `invalid_argument` for features of another mesh, or none on
/// faces that take samples; for `darts`, classes, and radii from a density.
GEODISK_API Result<Domain> feature_domain(const PreparedMesh& mesh, const SampleParams& params,
                                          const Features& features) noexcept;

/// Where a sample of such a domain lies.
enum class FeatureKind : std::uint8_t { face = 0, curve = 1, corner = 2 };

/// Tells the kind of a sample of such a domain, by its weights.
constexpr FeatureKind feature_of(const Sample& sample) noexcept {
    int zeros = 0;
    for (const float weight : sample.weights) {
        zeros += weight == 0 ? 1 : 0;
    }
    return zeros == 2 ? FeatureKind::corner : zeros == 1 ? FeatureKind::curve : FeatureKind::face;
}

} // namespace geodisk
