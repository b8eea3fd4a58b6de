// Finds vertices at the same position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geodisk/mesh_view.hpp"

namespace geodisk {

/// Hash table of vertices by position. The view must outlive it.
class PositionTable {
  public:
    explicit PositionTable(const MeshView& mesh);

    /// Returns the first vertex passed to this function with exactly the position of v, which must
    /// be finite. -0 equals 0.
    std::uint32_t first_at(std::uint32_t v);

    /// Does the same. Prefetches memory for the vertex `soon`, which a call in a moment will pass.
    std::uint32_t first_at(std::uint32_t v, std::uint32_t soon);

  private:
    /// Bits of the hash of a vertex, and the vertex.
    struct Slot {
        std::uint32_t tag;
        std::uint32_t vertex;
    };

    std::uint64_t hash(std::uint32_t v) const;
    bool coincide(std::uint32_t a, std::uint32_t b) const;
    /// Returns where vertices with this hash stand, or come to stand.
    std::size_t begin_of(std::uint64_t hash) const { return hash & (slots_.size() - 1); }
    void grow();

    const MeshView& mesh_;
    std::vector<Slot> slots_; ///< Size is a power of two; at most half are used.
    std::size_t used_ = 0;
};

} // namespace geodisk
