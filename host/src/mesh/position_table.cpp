#include "mesh/position_table.hpp"

#include <bit>
#include <utility>

#include "support/prefetch.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kFree = ~0u;
constexpr std::size_t kFewestSlots = 1024, kGrowth = 2;

std::uint32_t tag_of(std::uint64_t hash) {
    return static_cast<std::uint32_t>(hash >> 32);
}

} // namespace

PositionTable::PositionTable(const MeshView& mesh)
    : mesh_(mesh), slots_(kFewestSlots, Slot{0, kFree}) {}

std::uint32_t PositionTable::first_at(std::uint32_t v) {
    if (2 * used_ >= slots_.size()) {
        grow();
    }
    const std::uint64_t own = hash(v);
    for (std::size_t i = begin_of(own);; i = (i + 1) & (slots_.size() - 1)) {
        Slot& slot = slots_[i];
        if (slot.vertex == kFree) {
            slot = {tag_of(own), v};
            ++used_;
        }
        if (slot.vertex == v || (slot.tag == tag_of(own) && coincide(slot.vertex, v))) {
            return slot.vertex;
        }
    }
}

std::uint32_t PositionTable::first_at(std::uint32_t v, std::uint32_t soon) {
    prefetch(&slots_[begin_of(hash(soon))]);
    return first_at(v);
}

void PositionTable::grow() {
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(kGrowth * slots_.size(), Slot{0, kFree}));
    for (const Slot& slot : before) {
        if (slot.vertex != kFree) {
            std::size_t i = begin_of(hash(slot.vertex));
            while (slots_[i].vertex != kFree) {
                i = (i + 1) & (slots_.size() - 1);
            }
            slots_[i] = slot;
        }
    }
}

std::uint64_t PositionTable::hash(std::uint32_t v) const {
    std::uint64_t sum = 0;
    for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
        // Adding 0 turns -0 into 0.
        sum ^= std::bit_cast<std::uint64_t>(mesh_.coordinate(v, axis) + 0.0);
        sum *= 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return sum;
}

bool PositionTable::coincide(std::uint32_t a, std::uint32_t b) const {
    for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
        if (mesh_.coordinate(a, axis) != mesh_.coordinate(b, axis)) {
            return false;
        }
    }
    return true;
}

} // namespace geodisk
