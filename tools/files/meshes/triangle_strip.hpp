// Strips of triangles in mesh files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "files/meshes/polygon_mesh.hpp"

namespace geodisk::tools {

/// Adds the triangles of a strip to a mesh: each vertex makes one with the two before it, every
/// other one turned.
class TriangleStrip {
  public:
    explicit TriangleStrip(PolygonMesh& mesh) : mesh_(mesh) {}

    void add(std::uint32_t corner) {
        if (++length_ >= 3) {
            const bool is_turned = length_ % 2 == 0;
            mesh_.corners.insert(mesh_.corners.end(), {is_turned ? last_ : before_,
                                                       is_turned ? before_ : last_, corner});
            mesh_.face_ends.push_back(mesh_.corners.size());
        }
        before_ = std::exchange(last_, corner);
    }

    /// Begins another strip.
    void restart() { length_ = 0; }

  private:
    PolygonMesh& mesh_;
    std::size_t length_ = 0;
    std::uint32_t before_ = 0, last_ = 0;
};

} // namespace geodisk::tools
