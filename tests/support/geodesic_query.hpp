// Distances through the reference's Detector: from one face point to many.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geodisk/params.hpp"
#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "kernels/group_detect.hpp"
#include "lib/frame.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

inline constexpr double kUnreachable = std::numeric_limits<double>::infinity();

/// Returns tolerances that let errors of double rounding show: margin and slack of 2^-30, a
/// thousand times the smallest offset.
ref::Tolerances tight_tolerances();

/// "All distances from this point to those within reach." Lengths are in mesh units; inside, the
/// reach is the unit, as the minimum distance is in a run.
template <class Real>
class GeodesicQuery {
  public:
    GeodesicQuery(PreparedMesh mesh, double reach, const std::vector<Point>& targets,
                  const ref::Tolerances& tolerances);
    GeodesicQuery(const GeodesicQuery&) = delete;
    GeodesicQuery& operator=(const GeodesicQuery&) = delete;

    /// Per target the length of the shortest path found, or kUnreachable.
    std::vector<double> from(const Point& source);

    /// The same as a group computes it; nothing where windows must be trimmed.
    std::optional<std::vector<double>> by_group_from(const Point& source);

    /// Trims windows from the start of all disks.
    void trim_all() { detector_.trim_all(); }

    /// Returns what the last call took.
    const ref::DiskCount& count() const { return count_; }

  private:
    template <class Detector>
    std::vector<double> from_by(Detector& detector, const Point& source);

    PreparedMesh mesh_;
    ref::Surface<Real> surface_;
    ref::Bins<Real> bins_;
    ref::Detector<Real> detector_;
    ref::GroupDetector<Real> group_;
    ref::DiskCount count_;
};

/// Returns what the library measures on the CPU from a point to others, kUnreachable beyond the
/// reach; nothing where windows are too many for it. Weights are multiples of 2^-24.
std::optional<std::vector<double>> library_distances(const PreparedMesh& mesh, double reach,
                                                     const Point& source,
                                                     const std::vector<Point>& targets);

} // namespace geodisk::test
