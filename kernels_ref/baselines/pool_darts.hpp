// Samples chosen from a pool of candidates, sequentially.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "baselines/disk_query.hpp"

namespace geodisk::ref {

/// Throws darts by definition, over all pairs: visits the ranks 0 to count - 1 upwards and accepts
/// each for which `is_close(accepted, rank)` is false for all accepted ones. Returns them
/// ascending.
template <class IsClose>
std::vector<std::uint32_t> throw_brute_force(std::uint32_t count, IsClose&& is_close) {
    std::vector<std::uint32_t> accepted;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        if (std::none_of(accepted.begin(), accepted.end(),
                         [&](std::uint32_t other) { return is_close(other, rank); })) {
            accepted.push_back(rank);
        }
    }
    return accepted;
}

/// Returns the same set from disks: each accepted rank removes those in its disk. Ascending.
std::vector<std::uint32_t> throw_in_order(DiskQuery& disks);

/// Eliminates a pool without priorities (the pruning of Corsini, Cignoni and Scopigno, "Efficient
/// and flexible sampling with blue noise properties of triangular meshes", 2012, without their
/// hierarchy of cells): picks a random remaining candidate and removes its disk, until none
/// remains. Returns ranks in the order picked.
std::vector<std::uint32_t> eliminate_pool(DiskQuery& disks, std::uint64_t seed);

} // namespace geodisk::ref
