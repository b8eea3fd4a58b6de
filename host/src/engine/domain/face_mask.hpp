// The faces that take samples: SampleParams::face_mask.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"
#include "engine/domain/upload_parts.hpp"

namespace geodisk {

/// Returns true if the face takes samples.
inline bool takes_samples(const SampleParams& params, std::uint32_t face) {
    return params.face_mask.empty() || params.face_mask[face] != 0;
}

/// Effective areas of a surface.
struct Areas {
    double whole = 0; ///< Without the mask. Disks reach over all of it.
    double taken = 0; ///< effective_area(): of the faces that take samples.
};

/// Returns the effective_area() without the mask.
double whole_area(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// Returns frame_of() a surface with these areas, for parameters that check_params() finds no fault
/// with. Errors: those of check_candidates().
Result<JobFrame> frame_with(const PreparedMesh& mesh, const SampleParams& params,
                            const Areas& areas);

/// Returns the frame of disks with these parameters, where no candidate is decided. Errors: those
/// of frame_of() that concern disks.
Result<JobFrame> frame_of_disks(const PreparedMesh& mesh, const SampleParams& params);

/// Checks that a mask, if there is one, has a byte for each face.
Result<Done> check_mask_size(const PreparedMesh& mesh, std::span<const std::uint8_t> mask);

/// Checks the mask against the mesh.
Result<Done> check_mask(const PreparedMesh& mesh, const SampleParams& params);

/// Returns the bytes of the masks of all surfaces: a bit per face, in whole rows. 0 without masks.
std::size_t mask_bytes(PlacedSurfaces surfaces);
/// Appends the masks.
void add_mask(PlacedSurfaces surfaces, UploadParts& parts);

} // namespace geodisk
