// Global properties of a job on a surface. They are derived from the documents and not by the
// library's formulas: a wrong one in either shows where the two are compared.
#pragma once

#include <cstdint>

#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "lib/stages.hpp"

namespace geodisk::ref {

/// Lengths that allow for rounding, in units of the frame (host/docs/precision.md).
struct Tolerances {
    float limit;        ///< 1 + guard: what is below conflicts.
    float margin;       ///< A window is dropped only when beaten by more than this.
    float slack;        ///< Intervals are widened by this for hits and apexes.
    double guard;       ///< Promised spacing is kept by this much more.
    double error_bound; ///< Bound on the error of a distance.
    /// Terms that an error that exceeds the bound is computed from.
    float base_error;
    float crossing_error;
};

struct Frame {
    double unit = 0;         ///< Unit of lengths, in mesh units.
    double longest_edge = 0; ///< In units of `unit`.
    StageRule stages;
    /// Candidates of all classes together per candidate with the minimum distance for all.
    double candidates_of_classes = 1;
    std::uint32_t chain = 0;    ///< Crossings to provide for at first.
    bool radii_vary = false;    ///< Their rounding needs room, and small ones a finer guard.
    bool nearest_first = false; ///< Vertex events are taken by distance, not as they came.
    /// No edge has three faces. Only then a vertex lies between any two ways into an edge, and the
    /// order of their rays tells which window serves which side ("one angle, one split").
    bool splits_once = false;
    /// Faces are triangles of a space, so that within a face no way is shorter than the straight
    /// one: a shortest path enters none twice.
    bool straight_faces = false;

    /// Returns the samples expected on an area, in mesh units.
    double samples_on(double area) const;
    /// Returns the candidates that a stage expects per unit of area.
    float intensity(std::uint32_t stage) const;
    /// Returns a bound on the error of a distance over this many crossings, in a disk that trims or
    /// not.
    double error_of(std::uint32_t crossings, bool trims = false) const;
    double guard_for(double error_bound) const;
    /// Returns the tolerances for an error bound; without one, for the first.
    Tolerances tolerances(double error_bound) const;
    double first_error() const { return error_of(chain); }
    Tolerances tolerances() const { return tolerances(first_error()); }
};

/// Returns the frame of a job.
Frame frame_of(const PreparedMesh& mesh, const SampleParams& params);

/// Returns the frame for disks of one size, without a pool.
Frame frame_of(const PreparedMesh& mesh, double min_distance);

/// Returns true if the mask of the job leaves the face.
inline bool takes_samples(const SampleParams& params, std::uint32_t face) {
    return params.face_mask.empty() || params.face_mask[face] != 0;
}

/// Returns the candidates of all classes together per candidate with the minimum distance for all:
/// a class has the more the smaller its distance; 1 without classes.
double candidates_of_classes(const SampleParams& params);

/// Returns the area of a face, in mesh units.
double area_of(const PreparedMesh& mesh, std::uint32_t face);

} // namespace geodisk::ref
