// Generated surfaces that stand for real meshes, which are not in the repository: each has what
// makes those hard.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"

namespace geodisk::test {

/// Facts about a mesh.
struct KnownMesh {
    std::string_view name;
    std::uint64_t vertices, triangles, border_edges, components, crowded_edges;
    double area, longest_edge; ///< To five digits, as is `box`, the size of the bounding box.
    tools::Vec3 box;
};

struct StandIn {
    KnownMesh known;
    std::span<const std::string_view> files; ///< The real meshes that it stands for.
    tools::MeshFile (*make)();               ///< The same on every machine.
};

std::span<const StandIn> stand_ins();

/// The one of that name, or that stands for that file. Throws std::logic_error where none does.
const StandIn& stand_in(std::string_view name);

} // namespace geodisk::test
