// Creases: edges where faces meet at an angle.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/mesh_view.hpp>

namespace geodisk::tools {

/// Degrees by which faces turn at a crease, where nothing else is asked for.
inline constexpr double kCrease = 30;

/// Returns the edges where faces turn by more than that, and those of more than two faces, each by
/// one of its half-edges. `mesh` was prepared from `view`. Throws UserError for degrees out of 1 to
/// 180.
std::vector<std::uint32_t> crease_edges(const MeshView& view, const PreparedMesh& mesh,
                                        double degrees = kCrease);

} // namespace geodisk::tools
