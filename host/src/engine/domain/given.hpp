// Samples that are given to a job, and points to avoid: checked, and as the device takes them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"
#include "engine/domain/upload_parts.hpp"
#include "samples.h"

namespace geodisk {

/// Checks the given samples and points to avoid of a job. Errors name the sample.
Result<Done> check_given(const PreparedMesh& mesh, const SampleParams& params);

/// Appends given samples that check_given() finds no fault with, with their classes as orders.
/// Their faces are numbered from `first_face` on; weights are rounded to multiples of 2^-24.
void add_given(const SampleParams& params, std::uint32_t first_face,
               std::vector<gpu::SampleRec>& settled);

/// Appends the points to avoid on a surface.
void add_avoided(const PlacedSurface& surface, std::vector<gpu::SampleRec>& settled);

} // namespace geodisk
