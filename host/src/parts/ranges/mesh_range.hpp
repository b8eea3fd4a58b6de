// MeshRange: the share of a mesh file that one process reads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace geodisk {

/// Numbers 0 to `count` in blocks of equal size, one for each process. The last may be smaller, or
/// empty.
struct Blocks {
    std::uint64_t count = 0;
    std::uint32_t processes = 1;

    std::uint64_t each() const {
        return std::max<std::uint64_t>(1, (count + processes - 1) / processes);
    }
    std::uint64_t first(std::uint32_t process) const { return std::min(count, each() * process); }
    std::uint64_t size(std::uint32_t process) const { return first(process + 1) - first(process); }
    std::uint32_t owner(std::uint64_t number) const {
        return static_cast<std::uint32_t>(number / each());
    }
};

/// Meaning of the values at vertices for radii.
enum class RadiusKind : std::uint8_t {
    same,    ///< Radii do not vary.
    factor,  ///< Values are radius factors: RadiusField::prepare().
    density, ///< Values are a density: RadiusField::from_density().
};

/// The faces and the vertices of one process's blocks.
struct MeshRange {
    Blocks faces, vertices;               ///< Blocks of the whole mesh.
    std::vector<std::uint32_t> triangles; ///< Three vertices of the whole per face.
    std::vector<double> positions;        ///< Three coordinates per vertex.
    RadiusKind radii = RadiusKind::same;
    std::vector<double> values; ///< One per vertex; empty if radii do not vary.
    bool has_mask = false;
    /// With a mask, 1 per vertex and per face where it allows samples. A face takes them if it and
    /// its corners do.
    std::vector<std::uint8_t> vertex_mask, face_mask;
    bool needs_borders = false; ///< Their length is wanted.
};

} // namespace geodisk
