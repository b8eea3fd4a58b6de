#include "parts/ranges/examine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "mesh/checks.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/mesh_digest.hpp"
#include "parts/ranges/homes.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

// As PreparedMesh::prepare() takes them.
constexpr double kLargestCoordinate = 1e100;

Error rejected(std::string message) {
    return Error{Status::mesh_rejected, std::move(message)};
}

std::array<std::uint32_t, 3> face_at(const MeshRange& range, std::size_t face) {
    return {range.triangles[3 * face], range.triangles[3 * face + 1],
            range.triangles[3 * face + 2]};
}

/// Contribution of one process to the findings.
struct VertexShare {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double longest_edge = 0;
    std::uint64_t repeated = 0, flat = 0;
    std::uint64_t borders = 0, nonmanifold = 0, turned = 0;
    std::uint64_t digest = 0;
};

/// Measures the faces of a range one by one, in blocks. `first` is the number of the first one.
void measure(const MeshRange& range, std::uint64_t first, RangeFaces& faces, VertexShare& share) {
    const std::size_t count = range.triangles.size() / 3;
    faces.areas.resize(count);
    const ThreadOptions alone{1};
    std::vector<std::uint32_t> triangles;
    UninitializedVector<HalfEdge> edges;
    UninitializedVector<Link> links;
    for (std::size_t begin = 0; begin < count; begin += kBlock) {
        const std::size_t end = std::min(begin + kBlock, count);
        triangles.clear();
        for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
            triangles.push_back(faces.numbers.of(range.triangles[i]));
        }
        MeshStatistics block;
        place_faces(alone, MeshView{faces.positions, triangles, 3}, edges, links, block);
        share.repeated += block.repeated_index_faces;
        share.flat += block.zero_area_faces;
        share.longest_edge = std::max(share.longest_edge, block.longest_edge);
        for (std::size_t face = begin; face < end; ++face) {
            const auto of_face = std::span(edges).subspan(3 * (face - begin)).first<3>();
            const double area = 0.5 * of_face[0].length * of_face[0].apex_y;
            share.digest += face_digest(first + face, &range.triangles[3 * face], of_face);
            faces.areas[face] = area;
            for (std::size_t k = 0; k < 3 && takes_part(face_at(range, face)); ++k) {
                const std::size_t at = std::size_t{3} * triangles[3 * (face - begin) + k];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double x = faces.positions[at + axis];
                    share.low[axis] = std::min(share.low[axis], x);
                    share.high[axis] = std::max(share.high[axis], x);
                }
            }
        }
    }
}

/// An edge of a face, at the home of its lower vertex.
struct FaceEdge {
    std::uint32_t low, high;
    /// Twice the third vertex of the face, and 1 if the edge runs from the lower vertex to the
    /// higher one.
    std::uint32_t third_and_way;

    auto operator<=>(const FaceEdge&) const = default;
    bool joins_as(const FaceEdge& other) const { return low == other.low && high == other.high; }
    std::uint32_t third() const { return third_and_way >> 1; }
    bool rises() const { return (third_and_way & 1u) != 0; }
};
static_assert(sizeof(FaceEdge) == 12);

using EdgeEnds = std::pair<std::uint32_t, std::uint32_t>;

/// Counts the edges that came together, and notes those on borders. Returns false if a face has a
/// copy.
bool count_edges(std::vector<FaceEdge>& edges, VertexShare& share, std::vector<EdgeEnds>& borders) {
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        for (end = begin + 1; end < edges.size() && edges[end].joins_as(edges[begin]); ++end) {
            if (edges[end].third() == edges[end - 1].third()) {
                return false;
            }
        }
        const std::size_t faces = end - begin;
        if (faces == 1) {
            borders.emplace_back(edges[begin].low, edges[begin].high);
        }
        share.borders += faces == 1;
        share.nonmanifold += faces > 2;
        share.turned += faces == 2 && edges[begin].rises() == edges[begin + 1].rises();
    }
    return true;
}

/// Sends each edge to the home of its lower vertex, turn by turn of these.
std::vector<EdgeEnds> link_edges(Talk& talk, const MeshRange& range, VertexShare& share) {
    const std::uint64_t turns = turns_for(range.faces.each() * 3 * sizeof(FaceEdge));
    std::vector<EdgeEnds> borders;
    std::optional<Error> error;
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        ByProcess<FaceEdge> sent(talk.size());
        for (std::size_t face = 0; face < range.triangles.size() / 3; ++face) {
            const auto corners = face_at(range, face);
            for (std::size_t k = 0; k < 3 && takes_part(corners); ++k) {
                const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
                const auto [low, high] = std::minmax(from, to);
                const std::uint64_t place = low % range.vertices.each();
                if (place * turns / range.vertices.each() == turn) {
                    sent[range.vertices.owner(low)].push_back(
                        {low, high, corners[(k + 2) % 3] << 1 | (from == low ? 1u : 0u)});
                }
            }
        }
        std::vector<FaceEdge> edges;
        for (const auto& some : talk.all_to_all(std::move(sent))) {
            edges.insert(edges.end(), some.begin(), some.end());
        }
        if (!count_edges(edges, share, borders)) {
            error = rejected("a face has the vertices of another one");
        }
    }
    talk.check(error ? &*error : nullptr);
    return borders;
}

/// The places of the ends of an edge.
using EdgePlaces = std::array<double, 6>;

std::size_t hash_of(const EdgePlaces& places) {
    std::size_t hash = 0;
    for (const double x : places) {
        hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

/// Returns the number of edges on borders that lie on others.
std::uint64_t coinciding_edges(Talk& talk, const MeshRange& range,
                               const std::vector<EdgeEnds>& borders) {
    std::vector<std::uint32_t> ends;
    for (const auto& [low, high] : borders) {
        ends.insert(ends.end(), {low, high});
    }
    const VertexNumbers numbers(std::move(ends));
    const std::vector<double> positions =
        fetch_positions(talk, range.vertices, range.positions, numbers.vertices());
    const auto place = [&](std::uint32_t vertex) {
        const std::size_t at = std::size_t{3} * numbers.of(vertex);
        // Adding 0 makes -0 equal to it.
        return std::array{positions[at] + 0.0, positions[at + 1] + 0.0, positions[at + 2] + 0.0};
    };
    std::uint64_t most = 0;
    for (const std::uint64_t count : talk.all(std::uint64_t{borders.size()})) {
        most = std::max(most, count);
    }
    const std::uint64_t turns = turns_for(most * sizeof(EdgePlaces));
    std::uint64_t found = 0;
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        ByProcess<EdgePlaces> sent(talk.size());
        for (const auto& [one, other] : borders) {
            const auto [a, b] = std::minmax({place(one), place(other)});
            const EdgePlaces places{a[0], a[1], a[2], b[0], b[1], b[2]};
            const std::size_t hash = hash_of(places);
            if (hash / talk.size() % turns == turn) {
                sent[hash % talk.size()].push_back(places);
            }
        }
        std::vector<EdgePlaces> edges;
        for (const auto& some : talk.all_to_all(std::move(sent))) {
            edges.insert(edges.end(), some.begin(), some.end());
        }
        std::sort(edges.begin(), edges.end());
        for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edges[end] == edges[begin]) {
                ++end;
            }
            found += end - begin > 1 ? end - begin : 0;
        }
    }
    return talk.sum(found);
}

} // namespace

RangeFaces faces_of(Talk& talk, const MeshRange& range) {
    std::optional<Error> error;
    for (std::size_t i = 0; i < range.triangles.size() && !error; ++i) {
        if (range.triangles[i] >= range.vertices.count) {
            error = rejected("face " + std::to_string(range.faces.first(talk.rank()) + i / 3) +
                             " names vertex " + std::to_string(range.triangles[i]) +
                             ", but there are only " + std::to_string(range.vertices.count));
        }
    }
    for (const double x : range.positions) {
        if (!(std::abs(x) <= kLargestCoordinate) && !error) {
            error = rejected("a vertex has coordinates that are not finite");
        }
    }
    talk.check(error ? &*error : nullptr);
    RangeFaces faces{VertexNumbers(range.triangles), {}, {}};
    faces.positions =
        fetch_positions(talk, range.vertices, range.positions, faces.numbers.vertices());
    return faces;
}

RangeFindings examine(Talk& talk, const MeshRange& range, RangeFaces& faces) {
    VertexShare share;
    measure(range, range.faces.first(talk.rank()), faces, share);
    // Areas are added in the order of the whole.
    const double area = sum_in_order(talk, faces.areas);
    const std::vector<EdgeEnds> borders = link_edges(talk, range, share);
    RangeFindings all;
    std::ranges::copy(VertexShare().low, all.low);
    std::ranges::copy(VertexShare().high, all.high);
    MeshStatistics& statistics = all.statistics;
    statistics.triangles = range.faces.count;
    statistics.area = area;
    for (const VertexShare& one : talk.all(share)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            all.low[axis] = std::min(all.low[axis], one.low[axis]);
            all.high[axis] = std::max(all.high[axis], one.high[axis]);
        }
        all.turned_edges += one.turned;
        all.digest += one.digest;
        statistics.longest_edge = std::max(statistics.longest_edge, one.longest_edge);
        statistics.repeated_index_faces += one.repeated;
        statistics.zero_area_faces += one.flat;
        statistics.boundary_edges += one.borders;
        statistics.nonmanifold_edges += one.nonmanifold;
    }
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sum += (all.high[axis] - all.low[axis]) * (all.high[axis] - all.low[axis]);
    }
    statistics.diagonal = std::sqrt(sum);
    std::optional<Error> error;
    if (!has_area(statistics.area, statistics.diagonal)) {
        error = rejected("no face has an area");
    }
    talk.check(error ? &*error : nullptr);
    if (coinciding_edges(talk, range, borders) > 0) {
        error = rejected("border edges lie on others and have to be joined");
    }
    talk.check(error ? &*error : nullptr);
    return all;
}

} // namespace geodisk
