// Texels: which face of a mesh covers each texel of a texture, and where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

struct TextureSize {
    std::uint32_t width = 0, height = 0;

    std::size_t texels() const { return std::size_t{width} * height; }
};

/// Takes four bytes for each texel. For what covers a centre, texture coordinates are rounded to
/// 1/256 texel, so that of faces side by side just one covers a centre on their edge.
class Texels {
  public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    /// Maximum texels of a coordinate, so that products are exact.
    static constexpr double kFarthest = 0x1p21;

    /// Finds the face of each texel: the lowest one that covers the centre. Outside of 0 to 1 the
    /// texture repeats. `mesh` needs texture_uvs, must outlive this, and its coordinates times the
    /// size may not exceed kFarthest.
    Texels(const MeshFile& mesh, TextureSize size);

    TextureSize size() const { return size_; }
    /// Returns the face of each texel or kNone, row by row; the first has the corner u = 0, v = 1.
    const std::vector<std::uint32_t>& faces() const { return faces_; }
    /// Moves the faces out.
    std::vector<std::uint32_t> take_faces() && { return std::move(faces_); }
    /// Returns the weights of the face's corners at the centre of a texel with a face, by texture
    /// coordinates that are not rounded: multiples of 2^-24 that sum to 1.
    std::array<float, 3> weights(std::size_t texel) const;

    std::uint64_t covered() const { return covered_; }
    /// Returns the number of texels that further faces cover, or a face again.
    std::uint64_t overlapping() const { return overlapping_; }
    /// Returns the number of faces with texture coordinates outside of 0 to 1.
    std::uint64_t repeating() const { return repeating_; }

  private:
    const MeshFile& mesh_;
    TextureSize size_;
    std::vector<std::uint32_t> faces_;
    std::uint64_t covered_ = 0, overlapping_ = 0, repeating_ = 0;
};

} // namespace geodisk::tools
