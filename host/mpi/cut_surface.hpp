// Divides a surface among processes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Returns the process of each face, so that all have about the same work and short borders. Each
/// has a face; there must be as many faces as processes.
Result<std::vector<std::uint32_t>> cut_surface(const PreparedMesh& mesh, const SampleParams& params,
                                               std::uint32_t processes);

/// Returns the part of each face, as METIS chooses it. Empty if it has no answer, or is not there.
std::vector<std::uint32_t> metis_parts(const PreparedMesh& mesh, std::span<const double> work,
                                       std::uint32_t parts);

} // namespace geodisk
