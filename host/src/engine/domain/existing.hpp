// Existing samples of a job, and points to avoid: checked, and as the device takes them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"
#include "engine/domain/upload_parts.hpp"
#include "samples.h"

namespace geodisk {

/// Checks that there are no more existing samples than the stop count.
Result<Done> check_stop_count(const SampleParams& params);

/// Checks the existing samples and points to avoid of a job. Errors name the sample.
Result<Done> check_existing(const PreparedMesh& mesh, const SampleParams& params);

/// Returns what is wrong with a point of a surface, as the end of a sentence, or "".
std::string fault_of(const Sample& point, const PreparedMesh& mesh);

/// Returns the weights of the second and third corner as multiples of 2^-24 that sum to at most 1.
std::array<float, 2> rounded_weights(const float (&weights)[3]);

/// Appends existing samples that check_existing() finds no fault with, with their classes as
/// orders. Their faces are numbered from `first_face` on; weights are rounded to multiples of
/// 2^-24.
void add_existing(const SampleParams& params, std::uint32_t first_face,
                  std::vector<gpu::SampleRec>& settled);

/// Appends the points to avoid on a surface.
void add_avoided(const PlacedSurface& surface, std::vector<gpu::SampleRec>& settled);

} // namespace geodisk
