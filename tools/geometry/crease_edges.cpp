#include "geometry/crease_edges.hpp"

#include <algorithm>
#include <iterator>

#include <geodisk/features.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

std::vector<std::uint32_t> crease_edges(const MeshView& view, const PreparedMesh& mesh,
                                        double degrees) {
    const Features features = take(Features::find(view, mesh, degrees));
    std::vector<std::uint32_t> found;
    std::ranges::copy_if(features.edges(), std::back_inserter(found), [&](std::uint32_t edge) {
        return around_half_edge(mesh.half_edges()[edge].around) != edge; // Else it is a border.
    });
    return found;
}

} // namespace geodisk::tools
