// The stages of a job on a surface, and how densely their candidates lie.
#pragma once

#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// Fewer candidates are not worth a pool.
inline constexpr double kMinPool = 64;

/// Returns the candidates of a pool per expected sample: as many as asked for, or those of the
/// least pool.
double pool_ratio_of(double asked, double samples);
/// Maximum ratio of candidates to expected samples, for a surface much smaller than a disk.
inline constexpr double kLargestRatio = 1e12;
/// Maximum edge length in distances: longer edges would need a guard of a percent.
inline constexpr double kLongestEdge = 4000;
/// From it on all stages of darts are alike.
inline constexpr std::uint32_t kLastOtherStage = 32;

/// The stages of a job that pool_size() finds no fault with.
GEODISK_API Stages stages_of(const PreparedMesh& mesh, const SampleParams& params);

/// The same, where effective_area() is known.
Stages stages_of(const PreparedMesh& mesh, const SampleParams& params, double area);

/// Returns the stages of a job on the whole that a frame is of.
Stages stages_in(const JobFrame& frame, const SampleParams& params);

/// Returns the stages of a job in a frame: that of the mesh itself, or of one that it is a part of.
Stages stages_in(const JobFrame& frame, const PreparedMesh& mesh, const SampleParams& params);

/// Checks parameters by themselves and against the mesh.
GEODISK_API Result<Done> check_params(const PreparedMesh& mesh, const SampleParams& params);

/// Checks the number of candidates, of all faces and of each. Returns the candidates of the job.
Result<std::uint32_t> check_candidates(const PreparedMesh& mesh, const SampleParams& params,
                                       const Stages& stages);

/// Samples expected per area of one distance squared.
GEODISK_API double samples_per_area() noexcept;

/// Candidates that a stage expects per unit of area, or where radii vary per unit of the integral
/// of 1 / g^2; lengths in units of JobFrame::unit. It follows from the distance alone, so that no
/// edit elsewhere changes it. `density` is class_density().
GEODISK_API float stage_intensity(const Stages& stages, std::uint32_t stage, double density = 1);

/// Returns the length of a border as distance_for_count() takes it: if radii vary, in multiples of
/// the largest one. `h` is the border's half-edge in the faces of `radii`.
double border_part(double length, const RadiusField* radii, std::uint32_t h);

/// Candidates that a face expects, where `per_area` are expected per unit of effective_area().
double expected_in_face(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t face,
                        double per_area);

/// Number of candidates that share a face.
class FaceCrowding {
  public:
    /// Adds the candidates of a surface.
    void add(const PreparedMesh& mesh, const SampleParams& params, const Stages& stages);
    /// Returns true if faces hold so few candidates that disks need not distinguish their cells.
    /// All faces then have one cell. The rule affects speed only.
    bool is_small() const noexcept;

  private:
    double sum_ = 0, squares_ = 0;
};

/// The same of one surface.
GEODISK_API bool has_small_faces(const PreparedMesh& mesh, const SampleParams& params);

} // namespace geodisk
