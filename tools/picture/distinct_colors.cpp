#include "picture/distinct_colors.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace geodisk::tools::picture {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The neighbours of each node, one list after the other.
class Neighbours {
  public:
    Neighbours(std::size_t count, std::span<const std::array<std::uint32_t, 2>> edges)
        : ends_(count + 1), nodes_(2 * edges.size()) {
        for (const auto& [a, b] : edges) {
            ++ends_[a + std::size_t{1}];
            ++ends_[b + std::size_t{1}];
        }
        for (std::size_t i = 0; i < count; ++i) {
            ends_[i + 1] += ends_[i];
        }
        std::vector<std::size_t> next(ends_.begin(), ends_.end() - 1);
        for (const auto& [a, b] : edges) {
            nodes_[next[a]++] = b;
            nodes_[next[b]++] = a;
        }
    }

    std::span<const std::uint32_t> of(std::size_t node) const {
        return std::span(nodes_).subspan(ends_[node], ends_[node + 1] - ends_[node]);
    }

  private:
    std::vector<std::size_t> ends_;
    std::vector<std::uint32_t> nodes_;
};

/// Returns the nodes in the order in which the one with the fewest neighbours left is taken out
/// (Matula and Beck 1983). In the opposite order, each has few neighbours before it: in a planar
/// graph at most five.
std::vector<std::uint32_t> smallest_first(std::size_t count, const Neighbours& neighbours) {
    std::vector<std::size_t> degrees(count);
    std::vector<std::vector<std::uint32_t>> by_degree;
    const auto put = [&](std::uint32_t node) {
        by_degree.resize(std::max(by_degree.size(), degrees[node] + 1));
        by_degree[degrees[node]].push_back(node);
    };
    for (std::uint32_t node = 0; node < count; ++node) {
        degrees[node] = neighbours.of(node).size();
        put(node);
    }
    std::vector<bool> is_out(count);
    std::vector<std::uint32_t> order;
    order.reserve(count);
    for (std::size_t degree = 0; order.size() < count;) {
        if (by_degree[degree].empty()) {
            ++degree;
            continue;
        }
        const std::uint32_t node = by_degree[degree].back();
        by_degree[degree].pop_back();
        if (is_out[node] || degrees[node] != degree) {
            continue; // Noted again with fewer.
        }
        is_out[node] = true;
        order.push_back(node);
        for (const std::uint32_t other : neighbours.of(node)) {
            if (!is_out[other]) {
                --degrees[other];
                put(other);
            }
        }
        degree -= std::min<std::size_t>(degree, 1);
    }
    return order;
}

} // namespace

std::vector<std::uint32_t> distinct_colors(std::size_t count,
                                           std::span<const std::array<std::uint32_t, 2>> edges) {
    const Neighbours neighbours(count, edges);
    const std::vector<std::uint32_t> order = smallest_first(count, neighbours);
    std::vector<std::uint32_t> colors(count, kNone);
    std::vector<std::uint32_t> user; // The latest node with a neighbour of that colour.
    for (std::size_t i = count; i-- > 0;) {
        const std::uint32_t node = order[i];
        for (const std::uint32_t other : neighbours.of(node)) {
            if (colors[other] != kNone) {
                user[colors[other]] = node;
            }
        }
        const auto unused =
            std::ranges::find_if(user, [&](std::uint32_t by) { return by != node; });
        colors[node] = static_cast<std::uint32_t>(unused - user.begin());
        if (unused == user.end()) {
            user.push_back(kNone);
        }
    }
    return colors;
}

} // namespace geodisk::tools::picture
