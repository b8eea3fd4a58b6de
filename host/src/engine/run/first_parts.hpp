// Into how many parts to divide a mesh that the device cannot hold.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/runner_impl.hpp"

namespace geodisk {

/// Returns true for an error that a run in parts may avoid.
bool is_too_large(const Error& error);

/// Returns how far disks of samples and points to avoid reach.
double reach_with(double of_samples, std::span<const KeepOut> avoid);

/// Returns the number of parts of a mesh that the device holds with all within `reach` around them,
/// about, for a run whose domain of the whole is `of`; 0 if it holds none, or if the mesh is not
/// too large.
std::uint32_t first_parts(const Runner::Impl& runner, const Domain::Impl& of,
                          const PreparedMesh& mesh, double reach);

} // namespace geodisk
