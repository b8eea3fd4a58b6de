// Into how many parts to divide a mesh that the device cannot hold.
#pragma once

#include <cstdint>

#include <geodisk/mesh.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/runner_impl.hpp"

namespace geodisk {

/// Returns true for an error that a run in parts may avoid.
bool is_too_large(const Error& error);

/// Returns the number of parts of a mesh that the device holds with all within `reach` around them,
/// about, for a run whose domain of the whole is `of`; 0 if it holds none, or if the mesh is not
/// too large.
std::uint32_t first_parts(const Runner::Impl& runner, const Domain::Impl& of,
                          const PreparedMesh& mesh, double reach);

} // namespace geodisk
