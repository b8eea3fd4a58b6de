#include "baselines/batches.hpp"

#include <algorithm>

#include "baselines/count_calls.hpp"
#include "kernels/resolve.hpp"

namespace geodisk::ref {
namespace {

/// Returns up to `slots` idle ranks from `first` on, ascending.
std::vector<std::uint32_t> select_idle(const std::vector<std::uint8_t>& states, std::uint32_t first,
                                       std::uint32_t slots) {
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t rank = first; rank < states.size() && ranks.size() < slots; ++rank) {
        if (states[rank] == kIdle) {
            ranks.push_back(rank);
        }
    }
    return ranks;
}

} // namespace

BatchRun run_batches(DiskQuery& disks, std::uint32_t slots, CallHistogram* calls) {
    constexpr std::uint32_t kNotActive = ~0u;
    BatchRun run;
    std::vector<std::uint8_t> states(disks.size(), kIdle);
    std::vector<std::uint8_t> is_open(disks.size(), 1);
    std::vector<std::uint32_t> slot_of(disks.size(), kNotActive);
    std::vector<std::uint32_t> disk;
    for (std::uint32_t first = 0;;) {
        const std::vector<std::uint32_t> ranks = select_idle(states, first, slots);
        if (ranks.empty()) {
            return run;
        }
        first = ranks.back() + 1;
        for (std::uint32_t slot = 0; slot < ranks.size(); ++slot) {
            slot_of[ranks[slot]] = slot;
        }
        std::vector<std::vector<std::uint32_t>> conflicts(ranks.size());
        std::vector<std::vector<std::uint32_t>> above(ranks.size());
        std::vector<std::uint8_t> accepted(ranks.size(), 0);
        for (std::size_t slot = 0; slot < ranks.size(); ++slot) {
            disks.find(ranks[slot], is_open, disk);
            for (const std::uint32_t other : disk) {
                if (other > ranks[slot]) {
                    conflicts[slot].push_back(other);
                } else {
                    above[slot].push_back(slot_of[other]);
                }
            }
            std::sort(above[slot].begin(), above[slot].end());
        }
        resolve_batch(ranks, conflicts, states);
        for (std::size_t slot = 0; slot < ranks.size(); ++slot) {
            is_open[ranks[slot]] = 0;
            slot_of[ranks[slot]] = kNotActive;
            if (states[ranks[slot]] == kAccepted) {
                run.ranks.push_back(ranks[slot]);
                accepted[slot] = 1;
                for (const std::uint32_t other : conflicts[slot]) {
                    is_open[other] = 0;
                }
            }
        }
        if (calls) {
            add_calls(*calls, count_calls(above, accepted));
        }
        run.disks += ranks.size();
        ++run.batches;
    }
}

} // namespace geodisk::ref
