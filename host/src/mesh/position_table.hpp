// Which vertices lie in one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geodisk/mesh_view.hpp"

namespace geodisk {

/// A hash table of vertices by their position. The view must outlive it.
class PositionTable {
  public:
    /// Takes so many vertices.
    PositionTable(const MeshView& mesh, std::size_t most);

    /// The first vertex asked for that has exactly the finite position of v, -0 being 0.
    std::uint32_t first_at(std::uint32_t v);

  private:
    std::size_t hash(std::uint32_t v) const;
    bool coincide(std::uint32_t a, std::uint32_t b) const;

    const MeshView& mesh_;
    std::vector<std::uint32_t> slots_; ///< A power of two, at most half of them taken.
};

} // namespace geodisk
