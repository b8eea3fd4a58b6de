#include "mesh/face_loss.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/connectivity.hpp"

namespace geodisk {
namespace {

// Two corners are joined by a chain of vertices, each within epsilon of the next. If all sides are
// longer than kChain epsilon, its first kChain vertices lie within that distance of a corner. The
// cells are twice as wide, so eight cells at most hold these vertices, and one of them an eighth.
constexpr double kChain = 256;
constexpr double kRounding = 1.01;
constexpr std::uint8_t kMaxInCell = 31; ///< Less than kChain / 8.
constexpr double kMaxCells = 0x1p40;    ///< Along an axis; more would round by too much.
constexpr std::size_t kSlotsPerVertex = 4;

bool has_short_side(const MeshView& mesh, double length) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.triangles.face(f);
        for (std::size_t k = 0; k < 3 && takes_part(face); ++k) {
            double sum = 0;
            for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
                const double side =
                    mesh.coordinate(face[k], axis) - mesh.coordinate(face[(k + 1) % 3], axis);
                sum += side / length * (side / length);
            }
            if (!(sum > 1)) {
                return true;
            }
        }
    }
    return false;
}

/// Counts vertices by cell. Cells that share a slot are counted together.
class CellCounts {
  public:
    CellCounts(const MeshView& mesh, double side)
        : mesh_(mesh), side_(side), axes_(std::min(mesh.dimension, 3u)),
          counts_(std::bit_ceil(kSlotsPerVertex * mesh.vertex_count() + 1)) {}

    /// Returns false if the vertex is one too many in its cell, or too far from the origin.
    bool add(std::uint32_t v) {
        std::uint64_t hash = 0;
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            const double cell = std::floor(mesh_.coordinate(v, axis) / side_);
            if (!(std::abs(cell) <= kMaxCells)) {
                return false;
            }
            hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
            hash *= 0x9e3779b97f4a7c15;
            hash ^= hash >> 32;
        }
        return ++counts_[hash & (counts_.size() - 1)] <= kMaxInCell;
    }

  private:
    const MeshView& mesh_;
    double side_;
    std::uint32_t axes_;
    std::vector<std::uint8_t> counts_;
};

} // namespace

bool keeps_all_faces(const MeshView& mesh, double epsilon) {
    const double chain = kRounding * kChain * epsilon;
    if (has_short_side(mesh, chain)) {
        return false;
    }
    CellCounts counts(mesh, 2 * chain);
    std::vector<bool> counted(mesh.vertex_count(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t v = mesh.triangles[i];
        if (!counted[v] && !counts.add(v)) {
            return false;
        }
        counted[v] = true;
    }
    return true;
}

} // namespace geodisk
