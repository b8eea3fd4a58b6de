// What makes float decisions safe: the unit in which the device measures, and the guard band
// (host/docs/precision.md).
#pragma once

#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// The unit in which the device measures: `min_distance`, or where that is beyond every geodesic
/// distance of the mesh, a bound of those. The samples are the same, and coordinates keep their
/// precision. Takes a search over the edges (milliseconds per 100,000 faces) when `min_distance`
/// exceeds the mesh's diagonal, else no time.
GEODISK_API double working_distance(const PreparedMesh& mesh, double min_distance) noexcept;

/// The same for a run: with radii that vary it is always min_distance, since the smaller ones may
/// matter however large that is.
GEODISK_API double working_distance(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// In units of the working distance.
struct Tolerances {
    float limit;  ///< 1 + guard: what is below conflicts.
    float margin; ///< A window is dropped only when beaten by more than this.
    float slack;  ///< Intervals are widened by this for hits and apexes.
    double guard;
};

/// How far rounding takes a distance on a mesh: by at most 2^-22 of the distances met at each
/// crossing of its window chain. The largest met is one disk plus the longest edge.
class GEODISK_API ErrorBound {
  public:
    ErrorBound(const PreparedMesh& mesh, double min_distance) noexcept;
    /// Where radii vary, with a little more for their rounding.
    ErrorBound(const PreparedMesh& mesh, const SampleParams& params) noexcept;

    /// The guard for chains of so many crossings: in steps of two from 2^-13 on, so that an edit
    /// somewhere does not decide anew about ties elsewhere.
    double guard_for(std::uint32_t chain) const noexcept;
    /// Whether a guard is wide enough for chains of so many crossings.
    bool covers(double guard, std::uint32_t chain) const noexcept;
    Tolerances tolerances(double guard) const noexcept;

  private:
    double roundings(std::uint32_t chain) const noexcept;

    double longest_; ///< Edge.
    double further_ = 0;
};

/// The guard to begin with, for a guess of the longest chain by the faces that a disk covers.
GEODISK_API double first_guard(const PreparedMesh& mesh, double min_distance) noexcept;
GEODISK_API double first_guard(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// Those of the guard to begin with.
template <class Params>
Tolerances first_tolerances(const PreparedMesh& mesh, const Params& params) noexcept {
    return ErrorBound(mesh, params).tolerances(first_guard(mesh, params));
}

} // namespace geodisk
