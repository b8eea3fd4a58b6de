// Domain: what is sampled, and by which distance. Sampler records and Runner runs them all alike.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <geodisk/box.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

namespace gpu {
struct SampleRec;
}

/// Distances that do not go along the surface.
enum class Metric : std::uint32_t {
    euclidean,   ///< The straight line.
    approximate, ///< The closed form of Bowers, Wang, Wei and Maletz 2010 by positions and normals:
                 ///< d * (asin(a) - asin(b)) / (a - b), with the straight distance d and the
                 ///< cosines a and b of its angles with both normals. Exact on planes and spheres.
};

/// One of several surfaces that are sampled as one job: an instance of a mesh.
struct SurfacePart {
    const PreparedMesh* mesh = nullptr;
    /// Of this surface alone, seed and distance included.
    SampleParams params;
    /// Of the instance: its lengths are those of the mesh so many times.
    double scale = 1;
};

/// A sampling job, checked, with what follows from it alone. Immutable, so any number of threads
/// may use one. It needs no device.
class GEODISK_API Domain {
  public:
    /// A surface by geodesic distance. The mesh, and the radii and keys of `params`, must outlive
    /// the domain and its runs.
    ///
    /// Errors: `invalid_argument` as pool_size(), and for more than 2^30 grid cells, naming the
    /// face.
    static Result<Domain> surface(const PreparedMesh& mesh, const SampleParams& params) noexcept;

    /// Surfaces by geodesic distance, in one job; what they refer to must outlive the domain and
    /// its runs. Each gets the samples that it would get by itself, whatever the others are; but
    /// where one alone takes a larger guard than 2^-13 (RunReport::guard), that holds for all of
    /// them. Faces and vertices of each follow those of the ones before. The order of samples is
    /// that of the job, and of each surface its own.
    ///
    /// Errors: `invalid_argument` as surface(), naming the part; for none, for a null mesh, for a
    /// scale that is not positive and finite, for throws or a stop count, for radii of some parts
    /// only, and where all together are too large to index with 32 bits.
    static Result<Domain> surfaces(std::span<const SurfacePart> parts) noexcept;

    /// A surface by distances through space, as other methods take them, for comparison. It is not
    /// what geodesic distance gives: sheets that come near each other in space keep each other's
    /// samples away although the way along the surface is long (paper sections 5.6 and 6.1). The
    /// candidates are those of surface(). `view` is what `mesh` was prepared from; both, and what
    /// they refer to, must outlive the domain and its runs.
    ///
    /// Candidates are placed to 2^-31 of the bounding box, so conflicts are tested against
    /// `min_distance * (1 + guard)` with RunReport::guard = 2^-20 + 2^-30 * box / D. No two samples
    /// are closer in space than D. Normals are those of the vertices, weighted by the areas of
    /// their faces, and interpolated.
    ///
    /// Errors: `invalid_argument` as pool_size(), for a view of another mesh, or one that has not
    /// three coordinates per vertex, for `radii`, and for a distance too small beside the box.
    static Result<Domain> surface_in_space(const MeshView& view, const PreparedMesh& mesh,
                                           const SampleParams& params, Metric metric) noexcept;

    /// A box. Errors: `invalid_argument` as pool_size().
    static Result<Domain> box(const BoxParams& box) noexcept;

    Domain(Domain&&) noexcept;
    Domain& operator=(Domain&&) noexcept;
    ~Domain();

    /// The first face of each surface, in the numbering of the job, and one past the last; empty of
    /// a box.
    std::span<const std::uint32_t> first_faces() const noexcept;
    /// Those in which the candidates come.
    const Stages& stages() const noexcept;
    /// Coordinates of a sample of a box: 1 to 6, in its units. 0 of a surface, whose samples have a
    /// face and weights.
    std::uint32_t dimension() const noexcept;
    /// Writes them; `point` must have as many.
    void coordinates(const gpu::SampleRec& sample, std::span<double> point) const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Domain(std::unique_ptr<const Impl> impl) noexcept;
    std::unique_ptr<const Impl> impl_;
};

} // namespace geodisk
