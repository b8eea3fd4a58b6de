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

// Distances are tested against D * (1 + guard). Long paths widen the guard; hardly ever by so much.
constexpr double kMinMargin = 0x1p-6;

} // namespace

double halo_margin(const JobFrame& frame) {
    return std::max(kMinMargin, 2 * ErrorModel(frame).guard_for(frame.error_bound));
}

HaloSearch::HaloSearch(const PreparedMesh& mesh)
    : mesh_(mesh), paths_(mesh), values_(mesh.vertex_count(), -kBeyond),
      marks_(mesh.face_count(), kNone) {}

std::vector<std::uint32_t> HaloSearch::search(std::span<const std::uint32_t> from, double reach) {
    for (const std::vector<std::uint32_t>& vertices : {paths_.reached(), changed_}) {
        for (const std::uint32_t vertex : vertices) {
            values_[vertex] = -kBeyond;
        }
    }
    reach_ = reach;
    for (const std::uint32_t face : from) {
        marks_[face] = kFound;
    }
    find_paths(from);
    std::vector<std::uint32_t> faces;
    const auto at_changed = [&](const auto& visit) {
        for (const std::uint32_t vertex : changed_) {
            const VertexFan& fan = mesh_.fans()[vertex];
            for (const std::uint32_t corner :
                 mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
                visit(vertex, corner / 3);
            }
        }
    };
    at_changed([&](std::uint32_t, std::uint32_t face) {
        if (marks_[face] == kNone) {
            marks_[face] = kSteep;
            faces.push_back(face);
        }
    });
    raise_to_slope(mesh_, reach, faces, values_, changed_);
    at_changed([&](std::uint32_t vertex, std::uint32_t face) {
        if (marks_[face] != kFound && distance(vertex) <= reach) {
            marks_[face] = kFound;
            faces.push_back(face);
        }
    });
    faces.insert(faces.end(), from.begin(), from.end());
    return unmarked(faces);
}

void HaloSearch::find_paths(std::span<const std::uint32_t> from) {
    paths_.restart(kBeyond * reach_);
    const auto at_corners = [&](const auto& visit) {
        for (const std::uint32_t face : from) {
            for (const HalfEdge& edge : mesh_.half_edges().subspan(std::size_t{3} * face, 3)) {
                visit(edge.origin);
            }
        }
    };
    // Only the rim of the faces has anything to tell.
    at_corners([&](std::uint32_t vertex) {
        if (values_[vertex] != 0 && is_inside(vertex)) {
            values_[vertex] = 0;
            paths_.end_at(vertex);
        }
    });
    const auto inside = static_cast<std::ptrdiff_t>(paths_.reached().size());
    at_corners([&](std::uint32_t vertex) { paths_.begin_at(vertex, 0); });
    const std::vector<double>& lengths = paths_.lengths();
    changed_.assign(paths_.reached().begin() + inside, paths_.reached().end());
    for (const std::uint32_t vertex : changed_) {
        values_[vertex] = -lengths[vertex] / reach_;
    }
}

std::vector<std::uint32_t> HaloSearch::unmarked(std::span<const std::uint32_t> faces) {
    std::vector<std::uint32_t> found;
    if (faces.empty()) {
        return found;
    }
    const auto [first, last] = std::ranges::minmax(faces);
    for (std::uint32_t face = first; face <= last; ++face) {
        if (std::exchange(marks_[face], kNone) == kFound) {
            found.push_back(face);
        }
    }
    return found;
}

bool HaloSearch::is_inside(std::uint32_t vertex) const {
    const VertexFan& fan = mesh_.fans()[vertex];
    return std::ranges::all_of(mesh_.corners().subspan(fan.first_corner, fan.corner_count),
                               [&](std::uint32_t corner) { return marks_[corner / 3] == kFound; });
}

double HaloSearch::nearest_corner(std::uint32_t face) const {
    const auto edges = mesh_.half_edges().subspan(std::size_t{3} * face, 3);
    return std::min(
        {distance(edges[0].origin), distance(edges[1].origin), distance(edges[2].origin)});
}

} // namespace geodisk
