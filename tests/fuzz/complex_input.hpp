// Small complexes of triangles from any bytes: slivers, needles, triangles without area, bow-ties,
// edges of many faces, one-sided ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "support/meshes.hpp"

namespace geodisk::test {

/// Numbers from the input, zeros beyond its end.
class Input {
  public:
    explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t next(std::uint32_t below) {
        const std::uint32_t value = at_ < bytes_.size() ? bytes_[at_++] : 0u;
        return value % below;
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

/// Mostly on a coarse grid, for coincidences; some a little beside it, for slivers.
inline double coordinate(Input& input) {
    const std::uint32_t value = input.next(256);
    return value % 9 + (value >= 224 ? 1e-5 : value >= 192 ? 1e-3 : 0);
}

inline TestMesh complex_of(Input& input) {
    TestMesh mesh;
    const std::uint32_t vertices = 3 + input.next(8);
    for (std::uint32_t v = 0; v < vertices; ++v) {
        const double x = coordinate(input), y = coordinate(input), z = coordinate(input);
        mesh.add_vertex({x, y, z});
    }
    const std::uint32_t faces = 1 + input.next(14);
    for (std::uint32_t f = 0; f < faces; ++f) {
        const std::uint32_t a = input.next(vertices), b = input.next(vertices);
        const std::uint32_t c = input.next(vertices);
        mesh.add_triangle(a, b, c);
    }
    return mesh;
}

} // namespace geodisk::test
