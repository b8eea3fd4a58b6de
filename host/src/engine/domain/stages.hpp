// The stages of a job on a surface, and how densely their candidates lie.
#pragma once

#include <geodisk/export.hpp>
#include <geodisk/params.hpp>

namespace geodisk {

/// Fewer candidates are not worth a pool.
inline constexpr double kLeastPool = 64;
/// From it on all stages of darts are alike.
inline constexpr std::uint32_t kLastOtherStage = 32;

/// The stages of a job that pool_size() finds no fault with.
GEODISK_API Stages stages_of(const PreparedMesh& mesh, const SampleParams& params);

/// Samples expected per area of one distance squared.
GEODISK_API double samples_per_area() noexcept;

/// Candidates that a stage expects per unit of area, or where radii vary per unit of the integral
/// of 1 / g^2; lengths in units of working_distance(). It follows from the distance alone, so that
/// no edit elsewhere changes it.
GEODISK_API float stage_intensity(const PreparedMesh& mesh, const SampleParams& params,
                                  std::uint32_t stage);

/// Candidates that a face expects, where `per_area` are expected per unit of effective_area().
double expected_in_face(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t face,
                        double per_area);

/// How many candidates share a face.
class FaceCrowding {
  public:
    /// Those of a surface.
    void add(const PreparedMesh& mesh, const SampleParams& params);
    /// Whether faces hold so few that disks need not tell their cells apart: all then have one
    /// cell. The rule bears on speed alone.
    bool is_small() const noexcept;

  private:
    double sum_ = 0, squares_ = 0;
};

/// The same of one surface.
GEODISK_API bool has_small_faces(const PreparedMesh& mesh, const SampleParams& params);

} // namespace geodisk
