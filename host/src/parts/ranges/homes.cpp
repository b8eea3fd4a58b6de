#include "parts/ranges/homes.hpp"

#include <array>

namespace geodisk {

ByProcess<std::uint32_t> by_home(const MeshBlocks& blocks, std::span<const std::uint32_t> numbers) {
    ByProcess<std::uint32_t> some(blocks.processes);
    auto first = numbers.begin();
    for (std::uint32_t home = 0; home < blocks.processes; ++home) {
        const auto last = std::lower_bound(first, numbers.end(), blocks.first(home + 1));
        some[home].assign(first, last);
        first = last;
    }
    return some;
}

std::uint64_t turns_of(Talk& talk, std::size_t numbers, std::size_t record_size) {
    std::uint64_t most = 0;
    for (const std::uint64_t count : talk.all(std::uint64_t{numbers})) {
        most = std::max(most, count);
    }
    return turns_for(most * record_size);
}

std::vector<double> fetch_positions(Talk& talk, const MeshBlocks& blocks,
                                    std::span<const double> own,
                                    std::span<const std::uint32_t> vertices) {
    using Position = std::array<double, 3>;
    std::vector<double> positions;
    positions.reserve(3 * vertices.size());
    fetch<Position>(
        talk, blocks, vertices,
        [&](std::size_t at) {
            return Position{own[3 * at], own[3 * at + 1], own[3 * at + 2]};
        },
        [&](const Position& position) {
            positions.insert(positions.end(), position.begin(), position.end());
        });
    return positions;
}

} // namespace geodisk
