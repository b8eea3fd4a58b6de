#include "baselines/pool_darts.hpp"

#include <numeric>

#include "baselines/random.hpp"

namespace geodisk::ref {

std::vector<std::uint32_t> throw_in_order(DiskQuery& disks) {
    std::vector<std::uint32_t> accepted;
    std::vector<std::uint32_t> disk;
    std::vector<std::uint8_t> remains(disks.size(), 1);
    for (std::uint32_t rank = 0; rank < disks.size(); ++rank) {
        if (!remains[rank]) {
            continue;
        }
        remains[rank] = 0;
        accepted.push_back(rank);
        disks.find(rank, remains, disk);
        for (const std::uint32_t other : disk) {
            remains[other] = 0;
        }
    }
    return accepted;
}

std::vector<std::uint32_t> eliminate_pool(DiskQuery& disks, std::uint64_t seed) {
    RandomStream random(seed);
    std::vector<std::uint32_t> accepted;
    std::vector<std::uint32_t> disk;
    std::vector<std::uint8_t> remains(disks.size(), 1);
    // Remaining candidates, and the position of each in this list.
    std::vector<std::uint32_t> pool(disks.size());
    std::iota(pool.begin(), pool.end(), 0u);
    std::vector<std::uint32_t> places = pool;
    const auto remove = [&](std::uint32_t rank) {
        remains[rank] = 0;
        pool[places[rank]] = pool.back();
        places[pool.back()] = places[rank];
        pool.pop_back();
    };
    while (!pool.empty()) {
        const std::uint32_t rank = pool[random.below(static_cast<std::uint32_t>(pool.size()))];
        accepted.push_back(rank);
        remove(rank);
        disks.find(rank, remains, disk);
        for (const std::uint32_t other : disk) {
            remove(other);
        }
    }
    return accepted;
}

} // namespace geodisk::ref
