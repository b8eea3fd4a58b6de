// Divides the faces of a surface among processes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Errors: `invalid_argument` for more processes than faces.
GEODISK_API Result<Done> check_processes(const PreparedMesh& mesh, std::uint32_t processes);

/// Returns the share of the work that each face is expected to take: by the samples it holds, and
/// its memory. They sum to 1.
GEODISK_API std::vector<double> work_of_faces(const PreparedMesh& mesh, const SampleParams& params);

/// Returns the part of each face. Parts are halved, between faces that are far apart by steps
/// across edges, until each has its share of the work. Each has a face; there must be as many faces
/// as parts.
GEODISK_API std::vector<std::uint32_t>
halved_parts(const PreparedMesh& mesh, std::span<const double> work, std::uint32_t parts);

} // namespace geodisk
