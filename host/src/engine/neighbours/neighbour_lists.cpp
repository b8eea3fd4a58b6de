#include "engine/neighbours/neighbour_lists.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "support/blocks.hpp"

namespace geodisk {

NeighbourLists::NeighbourLists(const NeighbourQuery& query, double unit,
                               const ThreadOptions& threads)
    : query_(query), unit_(unit), threads_(threads) {
    lists_.offsets.reserve(query.sources.size() + 1);
    lists_.offsets.push_back(0);
}

std::size_t NeighbourLists::reduce(std::size_t source, std::span<Hit> hits) const {
    const double limit = query_.radii.empty() ? query_.within : query_.radii[source];
    const bool skips_own = query_.kind == NeighbourKind::sources;
    const auto kept = std::partition(hits.begin(), hits.end(), [&](const Hit& hit) {
        return double{hit.distance} <= limit && !(skips_own && hit.target == source);
    });
    const auto by_target = [](const Hit& hit) { return std::tuple(hit.target, hit.distance); };
    const auto by_distance = [](const Hit& hit) { return std::tuple(hit.distance, hit.target); };
    std::ranges::sort(hits.begin(), kept, {}, by_target);
    const auto end = std::unique(hits.begin(), kept,
                                 [](const Hit& a, const Hit& b) { return a.target == b.target; });
    const auto count = static_cast<std::size_t>(end - hits.begin());
    if (query_.nearest == 0) {
        return count;
    }
    const std::size_t most = std::min<std::size_t>(count, query_.nearest);
    std::ranges::partial_sort(hits.first(count), hits.begin() + static_cast<std::ptrdiff_t>(most),
                              {}, by_distance);
    return most;
}

void NeighbourLists::add(std::size_t sources, std::span<const gpu::HitRec> records,
                         std::span<const std::uint32_t> numbers) {
    std::vector<std::size_t> starts(sources + 1, 0);
    for (const gpu::HitRec& record : records) {
        ++starts[record.sample_index + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Hit> hits(records.size());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (const gpu::HitRec& record : records) {
        const std::uint32_t target = numbers.empty() ? record.target : numbers[record.target];
        hits[next[record.sample_index]++] = {target,
                                             static_cast<float>(double{record.distance} * unit_)};
    }
    const std::size_t first = lists_.offsets.size() - 1;
    std::vector<std::size_t> counts(sources);
    for_blocks(threads_, sources, [&](std::size_t begin, std::size_t end) noexcept {
        for (std::size_t i = begin; i < end; ++i) {
            counts[i] =
                reduce(first + i, std::span(hits).subspan(starts[i], starts[i + 1] - starts[i]));
        }
    });
    for (std::size_t i = 0; i < sources; ++i) {
        for (const Hit& hit : std::span(hits).subspan(starts[i], counts[i])) {
            lists_.indices.push_back(hit.target);
            lists_.distances.push_back(hit.distance);
        }
        lists_.offsets.push_back(lists_.indices.size());
    }
}

} // namespace geodisk
