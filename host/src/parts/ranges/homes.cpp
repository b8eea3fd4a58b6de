#include "parts/ranges/homes.hpp"

#include <algorithm>
#include <array>

namespace geodisk {

ByProcess<std::uint32_t> by_home(const Blocks& blocks, std::span<const std::uint32_t> vertices) {
    ByProcess<std::uint32_t> some(blocks.processes);
    auto first = vertices.begin();
    for (std::uint32_t home = 0; home < blocks.processes; ++home) {
        const auto last = std::lower_bound(first, vertices.end(), blocks.first(home + 1));
        some[home].assign(first, last);
        first = last;
    }
    return some;
}

std::vector<double> fetch_positions(Talk& talk, const Blocks& blocks, std::span<const double> own,
                                    std::span<const std::uint32_t> vertices) {
    using Position = std::array<double, 3>;
    std::vector<double> positions;
    positions.reserve(3 * vertices.size());
    std::uint64_t most = 0;
    for (const std::uint64_t count : talk.all(std::uint64_t{vertices.size()})) {
        most = std::max(most, count);
    }
    const std::uint64_t turns = turns_for(most * sizeof(Position));
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        const std::size_t begin = vertices.size() * turn / turns;
        const std::size_t end = vertices.size() * (turn + 1) / turns;
        const auto asked = talk.swap(by_home(blocks, vertices.subspan(begin, end - begin)));
        ByProcess<Position> told(talk.size());
        for (std::uint32_t other = 0; other < talk.size(); ++other) {
            told[other].reserve(asked[other].size());
            for (const std::uint32_t vertex : asked[other]) {
                const std::size_t at = 3 * (vertex - blocks.first(talk.rank()));
                told[other].push_back({own[at], own[at + 1], own[at + 2]});
            }
        }
        for (const auto& heard : talk.swap(std::move(told))) {
            for (const Position& position : heard) {
                positions.insert(positions.end(), position.begin(), position.end());
            }
        }
    }
    return positions;
}

} // namespace geodisk
