// Tolerances that make float decisions safe: the unit in which the device measures, and the guard
// band (host/docs/precision.md).
#pragma once

#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// The unit in which the device measures: `min_distance`, or where that is beyond every geodesic
/// distance of the mesh, a bound of those. The samples are the same, and coordinates keep their
/// precision. Takes a search over the edges (milliseconds per 100,000 faces) when `min_distance`
/// exceeds the mesh's diagonal, else no time.
GEODISK_API double working_distance(const PreparedMesh& mesh, double min_distance);

/// The same for a run: with radii that vary it is always min_distance, since the smaller ones may
/// matter however large that is.
GEODISK_API double working_distance(const PreparedMesh& mesh, const SampleParams& params);

/// In units of the working distance.
struct Tolerances {
    float limit;  ///< 1 + guard: what is below conflicts.
    float margin; ///< A window is dropped only when beaten by more than this.
    float slack;  ///< Intervals are widened by this for hits and apexes.
    double guard;
    double error_bound; ///< Error bound that they are for.
};

/// Error that rounding causes in a distance on a mesh. It is at most 2^-22 of the distances met at
/// each crossing of its window chain. The largest distance met is one disk plus the longest edge.
class GEODISK_API ErrorModel {
  public:
    /// The same error whatever the chain: of straight lines.
    explicit ErrorModel(double error = 0) : further_(error) {}
    /// Makes the model of a surface. If radii vary, it allows for their rounding.
    explicit ErrorModel(const JobFrame& frame);

    /// Makes it one that holds of another as well.
    void widen(const ErrorModel& other) noexcept;

    /// Returns the error of chains of so many crossings. A disk that trims adds more where edges
    /// are long: see crossing_error() of the shaders.
    double error_of(std::uint32_t chain, bool trims = false) const noexcept;
    /// Returns a guard that is safe while errors keep to the bound: powers of two from 2^-13 on,
    /// and where radii vary from 2^-15 on, so that an edit somewhere does not decide anew about
    /// ties elsewhere.
    double guard_for(double error_bound) const noexcept;
    Tolerances tolerances(double error_bound) const noexcept;

  private:
    double longest_ = 0; ///< Edge.
    double further_ = 0;
    double min_guard_ = 0x1p-13;
    double per_crossing_ = 0;
};

/// Returns the longest chain to begin with. It follows from the number of faces that a disk covers.
std::uint32_t guessed_chain(const PreparedMesh& mesh, double min_distance);

} // namespace geodisk
