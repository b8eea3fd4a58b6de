#include "mesh/position_table.hpp"

#include <bit>

namespace geodisk {
namespace {

constexpr std::uint32_t kFree = ~0u;

} // namespace

PositionTable::PositionTable(const MeshView& mesh, std::size_t most)
    : mesh_(mesh), slots_(std::bit_ceil(2 * most + 1), kFree) {}

std::uint32_t PositionTable::first_at(std::uint32_t v) {
    for (std::size_t slot = hash(v);; ++slot) {
        std::uint32_t& at = slots_[slot & (slots_.size() - 1)];
        if (at == kFree) {
            at = v;
        }
        if (at == v || coincide(at, v)) {
            return at;
        }
    }
}

std::size_t PositionTable::hash(std::uint32_t v) const {
    std::uint64_t sum = 0;
    for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
        // Adding 0 turns -0 into 0.
        sum ^= std::bit_cast<std::uint64_t>(mesh_.coordinate(v, axis) + 0.0);
        sum *= 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return static_cast<std::size_t>(sum);
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
