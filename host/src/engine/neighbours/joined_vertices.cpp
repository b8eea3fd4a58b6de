#include "engine/neighbours/joined_vertices.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace geodisk {
namespace {

/// The vertices joined with each one, ascending and including itself.
class Places {
  public:
    explicit Places(std::span<const std::uint32_t> joined)
        : starts_(joined.size() + 1, 0), vertices_(joined.size()) {
        for (const std::uint32_t to : joined) {
            ++starts_[to + 1];
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t v = 0; v < joined.size(); ++v) {
            vertices_[next[joined[v]]++] = v;
        }
    }

    std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        return std::span(vertices_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }

  private:
    std::vector<std::uint32_t> starts_, vertices_;
};

} // namespace

bool lists_joined(const NeighbourQuery& query) {
    return query.kind == NeighbourKind::vertices && !query.joined.empty() && query.nearest == 0;
}

void name_joined(std::span<const std::uint32_t> joined, Neighbours& neighbours) {
    const Places places(joined);
    std::vector<std::uint64_t> offsets{0};
    std::vector<std::uint32_t> indices;
    std::vector<float> distances;
    std::vector<std::pair<std::uint32_t, float>> row;
    for (std::size_t i = 0; i + 1 < neighbours.offsets.size(); ++i) {
        row.clear();
        for (std::size_t at = neighbours.offsets[i]; at < neighbours.offsets[i + 1]; ++at) {
            for (const std::uint32_t vertex : places.of(neighbours.indices[at])) {
                row.emplace_back(vertex, neighbours.distances[at]);
            }
        }
        std::ranges::sort(row);
        for (const auto& [vertex, distance] : row) {
            indices.push_back(vertex);
            distances.push_back(distance);
        }
        offsets.push_back(indices.size());
    }
    neighbours.offsets = std::move(offsets);
    neighbours.indices = std::move(indices);
    neighbours.distances = std::move(distances);
}

} // namespace geodisk
