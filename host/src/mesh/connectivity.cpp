#include "mesh/connectivity.hpp"

#include <algorithm>
#include <utility>

namespace geodisk {
namespace {

/// Returns a key that sorts the edges at a vertex by their other vertex, then by half-edge. Cycles
/// then do not depend on the sort algorithm.
std::uint64_t make_entry(std::uint32_t other, std::uint32_t half_edge) {
    return std::uint64_t{other} << 32 | half_edge;
}
std::uint32_t other_of(std::uint64_t entry) {
    return static_cast<std::uint32_t>(entry >> 32);
}
std::uint32_t half_edge_of(std::uint64_t entry) {
    return static_cast<std::uint32_t>(entry);
}

} // namespace

void list_corners(IndexView triangles, std::span<VertexFan> fans,
                  std::vector<std::uint32_t>& corners) {
    // ends[v] first counts the corners of v, then holds where they start, finally where they end.
    std::vector<std::uint32_t> ends(fans.size(), 0);
    for (std::size_t h = 0; h < triangles.size(); h += 3) {
        const auto face = triangles.face(h / 3);
        if (takes_part(face)) {
            ++ends[face[0]];
            ++ends[face[1]];
            ++ends[face[2]];
        }
    }
    std::uint32_t total = 0;
    for (std::size_t v = 0; v < fans.size(); ++v) {
        fans[v].first_corner = total;
        fans[v].corner_count = ends[v];
        total += std::exchange(ends[v], total);
    }
    corners.resize(total);
    for (std::size_t h = 0; h < triangles.size(); h += 3) {
        const auto face = triangles.face(h / 3);
        if (takes_part(face)) {
            corners[ends[face[0]]++] = static_cast<std::uint32_t>(h);
            corners[ends[face[1]]++] = static_cast<std::uint32_t>(h + 1);
            corners[ends[face[2]]++] = static_cast<std::uint32_t>(h + 2);
        }
    }
}

EdgeLinker::EdgeLinker(std::span<Link> links, std::uint32_t vertex_count)
    : links_(links), components_(vertex_count) {}

void EdgeLinker::link_at(std::uint32_t v, std::span<const std::uint32_t> corners) {
    entries_.clear();
    for (const std::uint32_t corner : corners) {
        const std::uint32_t back = previous_in_face(corner);
        const std::uint32_t next = links_[next_in_face(corner)].origin;
        const std::uint32_t previous = links_[back].origin;
        if (next > v) {
            entries_.push_back(make_entry(next, corner));
        }
        if (previous > v) {
            entries_.push_back(make_entry(previous, back));
        }
    }
    std::sort(entries_.begin(), entries_.end());
    ++vertices_;
    const std::span<const std::uint64_t> entries = entries_;
    for (std::size_t begin = 0; begin < entries.size();) {
        const std::uint32_t other = other_of(entries[begin]);
        std::size_t end = begin + 1;
        while (end < entries.size() && other_of(entries[end]) == other) {
            ++end;
        }
        link_cycle(entries.subspan(begin, end - begin));
        if (end - begin == 1) {
            borders_.push_back(half_edge_of(entries[begin]));
        }
        nonmanifold_edges_ += end - begin > 2;
        joins_ += components_.join(v, other);
        begin = end;
    }
}

void EdgeLinker::link_cycle(std::span<const std::uint64_t> cycle) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        Link& link = links_[half_edge_of(cycle[i])];
        const std::uint32_t next = half_edge_of(cycle[i + 1 < cycle.size() ? i + 1 : 0]);
        const bool same_way = link.origin == links_[next].origin;
        link.around = next << 1 | (same_way ? 1u : 0u);
    }
}

void EdgeLinker::count(MeshStatistics& statistics) const {
    statistics.components = vertices_ - joins_;
    statistics.boundary_edges = borders_.size();
    statistics.nonmanifold_edges = nonmanifold_edges_;
}

} // namespace geodisk
