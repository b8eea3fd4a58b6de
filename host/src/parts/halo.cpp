// An upper bound on distances, along edges, is lowered until no face has a gradient of more than 1.
// Then no path from the marked faces, where it is 0, is shorter than it.
#include "parts/halo.hpp"

#include <algorithm>
#include <utility>

#include "engine/domain/tolerances.hpp"
#include "mesh/edge_paths.hpp"
#include "mesh/slopes.hpp"

namespace geodisk {
namespace {

constexpr double kBeyond = 1.25;

/// Returns the shortest ways along edges, no longer than `most`, which is the value of all other
/// vertices.
std::vector<double> along_edges(const PreparedMesh& mesh, std::span<const std::uint8_t> is_marked,
                                double most) {
    EdgePaths paths(mesh, most);
    for (std::uint32_t h = 0; h < 3 * mesh.face_count(); ++h) {
        if (is_marked[h / 3] != 0) {
            paths.begin_at(mesh.half_edges()[h].origin, 0);
        }
    }
    return paths.lengths();
}

// Distances are tested against D * (1 + guard). Long paths widen the guard; hardly ever by so much.
constexpr double kMinMargin = 0x1p-6;

} // namespace

double halo_margin(const JobFrame& frame) {
    return std::max(kMinMargin, 2 * ErrorModel(frame).guard_for(frame.error_bound));
}

std::vector<double> distances_from(const PreparedMesh& mesh,
                                   std::span<const std::uint8_t> is_marked, double reach) {
    std::vector<double> values = along_edges(mesh, is_marked, kBeyond * reach);
    for (double& value : values) {
        value /= -reach;
    }
    values = raised_to_slope(mesh, reach, std::move(values));
    for (double& value : values) {
        value *= -reach;
    }
    return values;
}

double nearest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                      std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::min(
        {distances[edges[0].origin], distances[edges[1].origin], distances[edges[2].origin]});
}

double farthest_corner(const PreparedMesh& mesh, std::span<const double> distances,
                       std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::max(
        {distances[edges[0].origin], distances[edges[1].origin], distances[edges[2].origin]});
}

} // namespace geodisk
