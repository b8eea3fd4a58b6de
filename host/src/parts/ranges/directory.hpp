// Directory: which processes have faces at a vertex, and which components these belong to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh_range.hpp>

#include "parts/ranges/talk.hpp"
#include "parts/ranges/vertex_numbers.hpp"

namespace geodisk {

/// A face and its vertices, by their numbers in the whole.
struct WholeFace {
    std::uint32_t face;
    std::uint32_t corners[3];
};

/// Components of a surface, of which each process knows pieces.
struct WholeComponents {
    std::uint64_t count = 0;
    std::uint64_t vertices = 0; ///< Number of vertices that faces use.
    /// Number of pieces of each process. A piece is named by the process and a number.
    std::vector<std::uint32_t> pieces;
    /// Component of each piece, those of the first process first. At the first process alone.
    std::vector<std::uint32_t> of_pieces;
};

/// The holders of each vertex, at its home.
class Directory {
  public:
    /// All processes enter the vertices of their faces that take part.
    static Directory create(Talk& talk, const MeshBlocks& vertices,
                            std::span<const WholeFace> faces);

    /// Returns for each of some vertices, of this home, the processes that hold it.
    std::span<const std::uint32_t> holders(std::uint32_t vertex) const {
        const std::size_t at = vertex - first_;
        return std::span(holders_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
    }
    /// Returns own vertices that other processes hold too, ascending.
    const std::vector<std::uint32_t>& shared() const { return shared_; }
    const WholeComponents& components() const { return components_; }
    /// Returns the piece of each own face; that of a face that takes no part is 0.
    const std::vector<std::uint32_t>& pieces() const { return pieces_; }

  private:
    std::uint64_t first_ = 0;
    std::vector<std::uint32_t> starts_, holders_;
    std::vector<std::uint32_t> shared_, pieces_;
    WholeComponents components_;
};

} // namespace geodisk
