// Parts of a mesh: some of its faces, in their order, and the radii there.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geodisk/detail/uninitialized.hpp"
#include "geodisk/detail/vertex_sets.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/mesh_pieces.hpp"
#include "mesh/ranks.hpp"
#include "mesh/vertex_fans.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

Result<Done> check_faces(std::span<const std::uint32_t> faces, std::uint32_t count) {
    if (faces.empty()) {
        return invalid("a part of a mesh has at least one face");
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (faces[i] >= count) {
            return invalid("face " + std::to_string(faces[i]) +
                           " of the part does not exist; the "
                           "mesh has " +
                           std::to_string(count));
        }
        if (i > 0 && faces[i] <= faces[i - 1]) {
            return invalid("the faces of a part must ascend, but " + std::to_string(faces[i]) +
                           " follows " + std::to_string(faces[i - 1]));
        }
    }
    return Done{};
}

/// Returns HalfEdge::around of a half-edge in the part with these faces, where it is `own`.
std::uint32_t around_in_part(std::span<const HalfEdge> whole, const Ranks& faces, std::uint32_t h,
                             std::uint32_t own) {
    bool is_same_way = true;
    for (std::uint32_t g = h;;) {
        is_same_way = is_same_way == around_same_way(whole[g].around);
        g = around_half_edge(whole[g].around);
        const std::uint32_t face = faces.of(g / 3);
        if (g == h) {
            return lone_half_edge(own);
        }
        if (face != Ranks::kNone) {
            return (3 * face + g % 3) << 1 | (is_same_way ? 1u : 0u);
        }
    }
}

bool is_used(std::span<const HalfEdge> half_edges, std::uint32_t face) {
    const auto origin = [&](std::uint32_t k) { return half_edges[3 * face + k].origin; };
    return takes_part({origin(0), origin(1), origin(2)});
}

/// Makes the fans of a part: copies those whose corners are all there, and builds the others.
class PartFans {
  public:
    explicit PartFans(std::span<HalfEdge> edges)
        : edges_(edges), links_(edges.size()), builder_(links_) {}

    /// Fills in a fan with these corners of the part; `of_whole` has the order of the whole.
    void make(std::uint32_t vertex, std::span<std::uint32_t> corners, const VertexFan& of_whole,
              VertexFan& fan) {
        if (corners.size() == of_whole.corner_count) {
            fan.total_angle = of_whole.total_angle;
            fan.flags = of_whole.flags;
            return;
        }
        if (corners.empty()) {
            return;
        }
        std::sort(corners.begin(), corners.end());
        for (const std::uint32_t corner : corners) {
            for (std::uint32_t h = corner - corner % 3, end = h + 3; h < end; ++h) {
                links_[h] = {edges_[h].origin, edges_[h].around,
                             pack_corner_angle(edges_[h], edges_[previous_in_face(h)])};
            }
        }
        builder_.build(vertex, corners, fan);
        for (const std::uint32_t corner : corners) {
            edges_[corner].fan_angles = links_[corner].angle;
        }
    }

  private:
    std::span<HalfEdge> edges_;
    UninitializedVector<Link> links_; ///< Only those of faces at fans that are built.
    FanBuilder builder_;
};

/// Counts edges and components.
void count_edges(std::span<const HalfEdge> half_edges, std::size_t vertices,
                 MeshStatistics& statistics) {
    VertexSets components(vertices);
    statistics.components = statistics.vertices;
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        std::uint32_t faces = 1;
        bool is_first = is_used(half_edges, h / 3);
        for (std::uint32_t g = around_half_edge(half_edges[h].around); g != h && is_first;
             g = around_half_edge(half_edges[g].around)) {
            is_first = g > h;
            ++faces;
        }
        if (is_first) {
            statistics.boundary_edges += faces == 1;
            statistics.nonmanifold_edges += faces > 2;
            statistics.components -=
                components.join(half_edges[h].origin, half_edges[next_in_face(h)].origin);
        }
    }
}

/// Adds what the faces have by themselves to the statistics.
void measure_faces(std::span<const HalfEdge> half_edges, MeshStatistics& statistics) {
    const std::size_t faces = half_edges.size() / 3;
    UninitializedVector<double> areas(faces);
    std::vector<MeshStatistics> blocks(block_count(faces));
    for_blocks({}, faces, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            HalfEdge edges[3];
            std::copy_n(half_edges.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, edges);
            areas[f] = add_face(is_used(half_edges, static_cast<std::uint32_t>(f)), edges,
                                blocks[begin / kBlock]);
        }
    });
    sum_up(areas, blocks, statistics);
}

/// Copies three values per face.
std::vector<float> corners_of(std::span<const float> values, std::span<const std::uint32_t> faces) {
    std::vector<float> some;
    if (values.empty()) {
        return some;
    }
    some.reserve(3 * faces.size());
    for (const std::uint32_t face : faces) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(std::size_t{3} * face);
        some.insert(some.end(), first, first + 3);
    }
    return some;
}

} // namespace

PreparedMesh MeshPieces::part(const PreparedMesh& whole, std::span<const std::uint32_t> faces) {
    PreparedMesh part;
    const Ranks in_part(whole.face_count(), faces);
    auto& edges = part.half_edges_;
    edges.resize(3 * faces.size());
    const auto for_edges = [&](const auto& work) {
        for_blocks({}, faces.size(), [&](std::size_t begin, std::size_t end) {
            for (auto h = static_cast<std::uint32_t>(3 * begin); h < 3 * end; ++h) {
                work(h, 3 * faces[h / 3] + h % 3);
            }
        });
    };
    for_edges([&](std::uint32_t h, std::uint32_t there) { edges[h] = whole.half_edges_[there]; });
    const Ranks vertices(whole.vertex_count(), edges, &HalfEdge::origin);
    for_edges([&](std::uint32_t h, std::uint32_t there) {
        edges[h].origin = vertices.of(edges[h].origin);
        edges[h].around = around_in_part(whole.half_edges_, in_part, there, h);
    });
    const std::vector<std::uint32_t> vertices_there = vertices.numbers();
    part.fans_.resize(vertices_there.size());
    part.corners_.reserve(edges.size());
    PartFans fans(edges);
    for (std::uint32_t v = 0; v < part.fans_.size(); ++v) {
        const VertexFan& of_whole = whole.fans_[vertices_there[v]];
        const auto first = static_cast<std::uint32_t>(part.corners_.size());
        for (std::uint32_t i = 0; i < of_whole.corner_count; ++i) {
            const std::uint32_t there = whole.corners_[of_whole.first_corner + i];
            const std::uint32_t face = in_part.of(there / 3);
            if (face != Ranks::kNone) {
                part.corners_.push_back(3 * face + there % 3);
            }
        }
        VertexFan& fan = part.fans_[v];
        fan = {first, static_cast<std::uint32_t>(part.corners_.size()) - first, 0, 0};
        part.statistics_.vertices += fan.corner_count > 0;
        fans.make(v, std::span(part.corners_).subspan(first), of_whole, fan);
    }
    count_edges(edges, part.fans_.size(), part.statistics_);
    measure_faces(edges, part.statistics_);
    part.statistics_.diagonal = whole.statistics_.diagonal; // Coordinates are those of the whole.
    return part;
}

Result<PreparedMesh> PreparedMesh::part(std::span<const std::uint32_t> faces) const noexcept {
    return guarded([&]() -> Result<PreparedMesh> {
        GEODISK_TRY(check_faces(faces, face_count()));
        PreparedMesh part = MeshPieces::part(*this, faces);
        if (!(part.statistics_.area > 0)) {
            return Error{Status::mesh_rejected, "no face of the part has area"};
        }
        return part;
    });
}

RadiusField RadiusField::on_part(const PreparedMesh& part,
                                 std::span<const std::uint32_t> faces) const {
    RadiusField some;
    some.factors_ = corners_of(factors_, faces);
    some.spreads_ = corners_of(spreads_, faces);
    some.packing_ = corners_of(packing_, faces);
    some.largest_density_ = largest_density_;
    some.min_density_ = min_density_;
    some.densities_.reserve(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        some.densities_.push_back(densities_[faces[f]]);
        const HalfEdge& edge = part.half_edges()[std::size_t{3} * f];
        some.effective_area_ += 0.5 * edge.length * edge.apex_y * samples_in(faces[f]);
    }
    some.find_min_factor();
    return some;
}

} // namespace geodisk
