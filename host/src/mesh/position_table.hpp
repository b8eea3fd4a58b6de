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
    /// Makes a table for at most this many vertices.
    PositionTable(const MeshView& mesh, std::size_t most);

    /// Returns the first vertex passed to this function with exactly the position of v, which must
    /// be finite. -0 equals 0.
    std::uint32_t first_at(std::uint32_t v);

  private:
    std::size_t hash(std::uint32_t v) const;
    bool coincide(std::uint32_t a, std::uint32_t b) const;

    const MeshView& mesh_;
    std::vector<std::uint32_t> slots_; ///< Size is a power of two; at most half are used.
};

} // namespace geodisk
