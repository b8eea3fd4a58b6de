#include "mesh/connectivity.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace geodisk {
namespace {

std::uint32_t end_vertex(std::span<const HalfEdge> half_edges, std::uint32_t h) {
    return half_edges[next_in_face(h)].origin;
}

struct EdgeEntry {
    std::uint32_t other;     ///< The larger vertex of the edge.
    std::uint32_t half_edge;
};

/// Half-edges bucketed by the smaller vertex of their edge: a counting sort, so that the time stays
/// linear; a bucket holds about three edges.
struct EdgeBuckets {
    std::vector<std::uint32_t> starts;
    std::vector<EdgeEntry> entries;
};

EdgeBuckets bucket_edges(std::span<const HalfEdge> half_edges, std::uint32_t vertex_count) {
    EdgeBuckets buckets;
    buckets.starts.assign(std::size_t{vertex_count} + 1, 0);
    std::uint32_t total = 0;
    const auto count = static_cast<std::uint32_t>(half_edges.size());
    for (std::uint32_t h = 0; h < count; ++h) {
        if (takes_part(half_edges, h)) {
            const auto low = std::min(half_edges[h].origin, end_vertex(half_edges, h));
            ++buckets.starts[std::size_t{low} + 1];
            ++total;
        }
    }
    std::partial_sum(buckets.starts.begin(), buckets.starts.end(), buckets.starts.begin());
    buckets.entries.resize(total);
    std::vector<std::uint32_t> cursor(buckets.starts.begin(), buckets.starts.end() - 1);
    for (std::uint32_t h = 0; h < count; ++h) {
        if (takes_part(half_edges, h)) {
            const std::uint32_t a = half_edges[h].origin;
            const std::uint32_t b = end_vertex(half_edges, h);
            buckets.entries[cursor[std::min(a, b)]++] = {std::max(a, b), h};
        }
    }
    return buckets;
}

/// Joins the half-edges of one undirected edge into a cycle.
void link_cycle(std::span<HalfEdge> half_edges, std::span<const EdgeEntry> cycle) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        const std::uint32_t h = cycle[i].half_edge;
        const std::uint32_t next = cycle[(i + 1) % cycle.size()].half_edge;
        const bool same_way = half_edges[h].origin == half_edges[next].origin;
        half_edges[h].around = (next << 1) | (same_way ? 1u : 0u);
    }
}

class Components {
  public:
    explicit Components(std::uint32_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) {
            parent_[v] = parent_[parent_[v]];
            v = parent_[v];
        }
        return v;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

std::uint64_t count_components(std::span<const HalfEdge> half_edges, std::uint32_t vertex_count) {
    Components components(vertex_count);
    std::vector<bool> used(vertex_count, false);
    const auto count = static_cast<std::uint32_t>(half_edges.size());
    for (std::uint32_t h = 0; h < count; ++h) {
        if (takes_part(half_edges, h)) {
            components.join(half_edges[h].origin, end_vertex(half_edges, h));
            used[half_edges[h].origin] = true;
        }
    }
    std::uint64_t roots = 0;
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        roots += used[v] && components.find(v) == v;
    }
    return roots;
}

} // namespace

bool takes_part(std::span<const HalfEdge> half_edges, std::uint32_t h) {
    const std::uint32_t a = half_edges[h].origin;
    const std::uint32_t b = half_edges[next_in_face(h)].origin;
    const std::uint32_t c = half_edges[previous_in_face(h)].origin;
    return a != b && b != c && c != a;
}

void link_edges(std::span<HalfEdge> half_edges, MeshStatistics& statistics) {
    std::uint32_t vertex_count = 0;
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        vertex_count = std::max(vertex_count, half_edges[h].origin + 1);
        half_edges[h].around = h << 1 | 1u;
    }
    EdgeBuckets buckets = bucket_edges(half_edges, vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const std::span bucket(buckets.entries.begin() + buckets.starts[v],
                               buckets.entries.begin() + buckets.starts[std::size_t{v} + 1]);
        // Stable order within an edge, so that cycles do not depend on the sort used.
        std::sort(bucket.begin(), bucket.end(), [](const EdgeEntry& a, const EdgeEntry& b) {
            return a.other != b.other ? a.other < b.other : a.half_edge < b.half_edge;
        });
        for (std::size_t begin = 0; begin < bucket.size();) {
            std::size_t end = begin + 1;
            while (end < bucket.size() && bucket[end].other == bucket[begin].other) {
                ++end;
            }
            link_cycle(half_edges, bucket.subspan(begin, end - begin));
            statistics.boundary_edges += end - begin == 1;
            statistics.nonmanifold_edges += end - begin > 2;
            begin = end;
        }
    }
    statistics.components = count_components(half_edges, vertex_count);
}

} // namespace geodisk
