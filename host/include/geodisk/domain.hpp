// Domain: a surface or box to sample, and the distance to use. Sampler and Runner treat all alike.
// Stable.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <geodisk/box.hpp>
#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

namespace gpu {
struct SampleRec;
}

/// Distances through space.
enum class Metric : std::uint32_t {
    euclidean,   ///< Straight line.
    approximate, ///< Closed form of Bowers, Wang, Wei and Maletz 2010 by positions and normals:
                 ///< d * (asin(a) - asin(b)) / (a - b), with the straight distance d and the
                 ///< cosines a and b of its angles with both normals. Exact on planes and spheres.
};

/// One of several surfaces that are sampled as one job: an instance of a mesh.
struct SurfacePart {
    const PreparedMesh* mesh = nullptr;
    SampleParams params; ///< Parameters of this surface, including its seed and distance.
    double scale = 1;    ///< Length in the instance of a unit of the mesh.
};

/// A sampling job with checked parameters. Immutable: any number of threads may use one. Needs no
/// device.
class GEODISK_API Domain {
  public:
    /// Makes the domain of a surface by geodesic distance. The mesh, and the radii and keys of
    /// `params`, must outlive the domain and its runs. Existing samples are copied.
    ///
    /// Errors: those of pool_size(); `invalid_argument` for more than 2^30 grid cells, naming the
    /// face.
    static Result<Domain> surface(const PreparedMesh& mesh, const SampleParams& params) noexcept;

    /// Makes the domain of a surface in a frame: its own, or that of a mesh that it is a part of.
    /// Nothing about the whole is derived from `mesh` then. `darts` are counted on `mesh`
    /// alone.
    ///
    /// Errors: those above; `invalid_argument` for a frame of another distance, pool ratio or kind
    /// of radii, and for one that `mesh` does not fit: with a longer edge, with an edge of more
    /// faces, or without coordinates.
    static Result<Domain> surface(const PreparedMesh& mesh, const SampleParams& params,
                                  const JobFrame& frame) noexcept;

    /// Makes the domain of several surfaces by geodesic distance, as one job. Everything they refer
    /// to must outlive the domain and its runs. Each surface gets the samples that it gets alone,
    /// except that the largest guard (RunReport::guard) of one holds for all. Faces and vertices
    /// are numbered through all surfaces. Samples come in the order of the job, which keeps the
    /// order of each surface; existing ones first, surface by surface. If more than 32 surfaces
    /// have the same seed, the orders of each are increased by a number of its own.
    ///
    /// Errors: those of surface(), naming the part; `invalid_argument` for no part, a null mesh, a
    /// scale that is not positive and finite, darts or a stop count, radii for some parts only, or
    /// more faces and vertices than 32 bits count.
    static Result<Domain> surfaces(std::span<const SurfacePart> parts) noexcept;

    /// Makes the domain of a surface by distances through space, to compare with other methods.
    /// Sheets that are near each other in space then keep each other's samples away, even if the
    /// way along the surface is long (paper sections 5.6 and 6.1). The candidates are those of
    /// surface(). `mesh` was prepared from `view`. Both, and everything they refer to, must outlive
    /// the domain and its runs.
    ///
    /// Candidates are placed to 2^-31 of the bounding box, so conflicts are tested against
    /// `min_distance * (1 + guard)` with RunReport::guard = 2^-20 + 2^-30 * box / D. No two samples
    /// are closer in space than D. Normals are those of the vertices, weighted by the areas of
    /// their faces, and interpolated.
    ///
    /// Errors: those of pool_size(); `invalid_argument` for a view of another mesh, or without
    /// three coordinates per vertex, for `radii`, and for a distance too small for the bounding
    /// box.
    static Result<Domain> surface_in_space(const MeshView& view, const PreparedMesh& mesh,
                                           const SampleParams& params, Metric metric) noexcept;

    /// Makes the domain of a box by straight-line distance. Errors: those of pool_size().
    static Result<Domain> box(const BoxParams& box) noexcept;

    Domain(Domain&&) noexcept;
    Domain& operator=(Domain&&) noexcept;
    ~Domain();

    /// Returns the first face of each surface, in the numbering of the job, and one past the last.
    /// Empty for a box.
    std::span<const std::uint32_t> first_faces() const noexcept;
    /// Returns the stages in which candidates come.
    const Stages& stages() const noexcept;
    /// Returns the number of coordinates of a sample in a box, 1 to 6. 0 for a surface, whose
    /// samples have a face and weights.
    std::uint32_t dimension() const noexcept;
    /// Writes the coordinates of a sample in units of the box; `point` has dimension() elements.
    void coordinates(const gpu::SampleRec& sample, std::span<double> point) const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Domain(std::unique_ptr<const Impl> impl) noexcept;
    std::unique_ptr<const Impl> impl_;
};

} // namespace geodisk
