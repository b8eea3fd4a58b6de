// Digests of faces, whose sum is the digest of a surface: surface_digest().
#pragma once

#include <cstdint>
#include <span>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "geodisk/radius_field.hpp"

namespace geodisk {

/// Returns the digest of a face: of its number, its three vertices and its shape.
std::uint64_t face_digest(std::uint64_t face, const std::uint32_t* corners,
                          std::span<const HalfEdge, 3> edges);

/// Returns the digest of what a job has on a face: its number, its radii, which are those of a face
/// of `radii`, or null; and whether it takes samples.
std::uint64_t field_digest(std::uint64_t face, const RadiusField* radii, std::uint32_t in_radii,
                           bool takes_samples);

} // namespace geodisk
