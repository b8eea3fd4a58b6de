// MeshRange: the share of a mesh file that one process reads, of a mesh that none reads whole.
// Experimental.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include <geodisk/mesh.hpp>

namespace geodisk {

/// Numbers 0 to `count` in blocks of equal size, one for each process. The last may be smaller, or
/// empty.
struct MeshBlocks {
    std::uint64_t count = 0;
    std::uint32_t processes = 1;

    std::uint64_t each() const {
        return std::max<std::uint64_t>(1, (count + processes - 1) / processes);
    }
    /// Returns the first number of a process.
    std::uint64_t first(std::uint32_t process) const { return std::min(count, each() * process); }
    /// Returns how many numbers a process has.
    std::uint64_t size(std::uint32_t process) const { return first(process + 1) - first(process); }
    /// Returns the process that has a number.
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
    MeshBlocks faces, vertices;           ///< Blocks of the whole mesh.
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

/// Statistics of a mesh and of the radii and the mask on it, from its ranges.
struct RangedStatistics {
    MeshStatistics mesh; ///< As those of PreparedMesh::prepare(), to the bit.
    std::uint64_t unused_vertices = 0;
    std::uint64_t turned_edges = 0; ///< Edges of two faces that are turned over against each other.
    std::uint64_t digest = 0;       ///< surface_digest() of the whole.
    double effective_area = 0;      ///< effective_area() of the whole.
    double borders = 0;             ///< Length of all borders, for distance_for_count(), if wanted.
    std::optional<std::uint64_t> masked_faces{}; ///< Faces that the mask leaves; none without one.
};

} // namespace geodisk
