#include "parts/ranges/borders.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/domain/stages.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_frames.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

/// An edge of a face that takes samples, at the home of its lower vertex.
struct TakenEdge {
    std::uint32_t low, high;
    std::uint32_t half_edge; ///< Number in the whole: three per face.

    auto operator<=>(const TakenEdge&) const = default;
    bool joins_as(const TakenEdge& other) const { return low == other.low && high == other.high; }
};

/// Finds the edges that no other one joins, and sorts them by the processes that read their faces.
ByProcess<std::uint32_t> lone_edges(const Talk& talk, const MeshBlocks& faces,
                                    std::vector<TakenEdge> edges) {
    std::sort(edges.begin(), edges.end());
    ByProcess<std::uint32_t> lone(talk.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = begin + 1;
        while (end < edges.size() && edges[end].joins_as(edges[begin])) {
            ++end;
        }
        if (end == begin + 1) {
            lone[faces.owner(edges[begin].half_edge / 3)].push_back(edges[begin].half_edge);
        }
    }
    return lone;
}

/// Returns the half-edges of the range, from its first one, at which no other face takes samples.
/// Ascending.
std::vector<std::uint32_t> border_half_edges(Talk& talk, const MeshRange& range,
                                             std::span<const std::uint8_t> mask) {
    const auto first = static_cast<std::uint32_t>(3 * range.faces.first(talk.rank()));
    const std::uint64_t turns = turns_for(range.faces.each() * 3 * sizeof(TakenEdge));
    const std::uint64_t each = range.vertices.each();
    std::vector<std::uint32_t> borders;
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        ByProcess<TakenEdge> sent(talk.size());
        for (std::uint32_t h = 0; h < range.triangles.size(); ++h) {
            const std::uint32_t* const corners = &range.triangles[h - h % 3];
            if (!takes_part({corners[0], corners[1], corners[2]}) ||
                (!mask.empty() && mask[h / 3] == 0)) {
                continue;
            }
            const auto [low, high] =
                std::minmax(range.triangles[h], range.triangles[next_in_face(h)]);
            if (low % each * turns / each == turn) {
                sent[range.vertices.owner(low)].push_back({low, high, first + h});
            }
        }
        std::vector<TakenEdge> edges;
        for (const auto& some : talk.all_to_all(std::move(sent))) {
            edges.insert(edges.end(), some.begin(), some.end());
        }
        for (const auto& some : talk.all_to_all(lone_edges(talk, range.faces, std::move(edges)))) {
            for (const std::uint32_t half_edge : some) {
                borders.push_back(half_edge - first);
            }
        }
    }
    std::sort(borders.begin(), borders.end());
    return borders;
}

/// Appends the lengths of some borders of the range.
void add_lengths(const MeshRange& range, const RangeFaces& faces, const VertexRadii& radii,
                 std::span<const std::uint32_t> borders, std::vector<double>& lengths) {
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t h : borders) {
        for (std::uint32_t corner = h - h % 3; corner < h - h % 3 + 3; ++corner) {
            triangles.push_back(faces.numbers.of(range.triangles[corner]));
        }
    }
    UninitializedVector<HalfEdge> edges;
    UninitializedVector<Link> links;
    MeshStatistics ignored;
    place_faces(ThreadOptions{1}, MeshView{faces.positions, triangles, 3}, edges, links, ignored);
    std::optional<RadiusField> field;
    if (!radii.factors.empty()) {
        field = RadiusPieces::factors_on(triangles, radii);
    }
    for (std::uint32_t i = 0; i < borders.size(); ++i) {
        const std::uint32_t h = 3 * i + borders[i] % 3;
        lengths.push_back(border_part(edges[h].length, field ? &*field : nullptr, h));
    }
}

} // namespace

double border_length(Talk& talk, const MeshRange& range, const RangeFaces& faces,
                     const VertexRadii& radii, std::span<const std::uint8_t> mask) {
    const std::vector<std::uint32_t> borders = border_half_edges(talk, range, mask);
    std::vector<double> lengths;
    lengths.reserve(borders.size());
    for (std::size_t begin = 0; begin < borders.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, borders.size() - begin);
        add_lengths(range, faces, radii, std::span(borders).subspan(begin, count), lengths);
    }
    return sum_in_order(talk, lengths);
}

} // namespace geodisk
