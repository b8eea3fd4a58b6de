// Feature-aware sampling: a mesh lifted to more dimensions by weighted coordinates, so that its
// distances grow where normals turn or an attribute changes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Coordinates to append to every vertex: its unit normal or an attribute, times a weight.
struct Lift {
    std::string attribute; ///< A scalar vertex property; "" for the normal.
    double weight = 0;
};

/// "normals:W" or "attribute:NAME:W". Throws UserError(usage) naming the option.
Lift parse_lift(const std::string& option, const std::string& text);

/// The names in `lifts`, in their order: what MeshSources::attributes has to ask for.
std::vector<std::string> lift_attributes(std::span<const Lift> lifts);

struct LiftedPositions {
    std::vector<double> positions; ///< `dimension` per vertex.
    std::uint32_t dimension = 0;
};

/// The positions of `mesh`, read with lift_attributes(), with those of each lift appended.
///
/// Vertices that are joined have the mean of their attributes. The normal of a vertex is the mean
/// of its faces' normals, weighted by their angles at it. Throws UserError(usage) when the sum is
/// more than 8 dimensions, or normals are asked of a mesh that is not in space;
/// UserError(bad_input) with `path` and the vertex, counted from 0, where a used vertex has no
/// normal or no finite attribute.
LiftedPositions lifted_positions(const std::string& path, const MeshFile& mesh,
                                 std::span<const Lift> lifts);

} // namespace geodisk::tools
