// The prepared mesh in units of its job's frame, in the precision of the twin.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "constants.h"
#include "geodisk/mesh.hpp"
#include "geodisk/params.hpp"
#include "lib/frame.hpp"
#include "lib/scalar.hpp"

namespace geodisk::ref {

template <class Real>
struct Edge {
    Real length, apex_x, apex_y, cosine, sine;
    std::uint32_t origin, around, fan_angles;
};

/// The radii at the corners of a face, or where they come from a density its packing, negative; how
/// far disks reach into it (RadiusField::reach_bounds), and what candidates are proposed by
/// (RadiusField::spreads).
template <class Real>
struct FaceRadii {
    Real corner[3];
    Real bound;
    float spread[3];

    bool has_packing() const { return corner[0] < 0; }
    /// Returns the radius for a value that is linear between the corners.
    static Real radius_of(Real value) {
        return value < 0 ? ratio(static_cast<Real>(0.5), root(-value)) : value;
    }
    Real largest() const { return radius_of(std::max({corner[0], corner[1], corner[2]})); }
};

/// The classes of candidates: distances of pairs, and random words that stand for them.
template <class Real>
struct Classes {
    std::uint32_t count = 0;  ///< 0 if there are no classes.
    Real distance[8][8]{};    ///< In units of the frame.
    Real reach[8]{};          ///< Largest distance of each class.
    std::uint64_t ends[8]{};  ///< Random words below it are of a class up to this.
    std::uint64_t turns[8]{}; ///< Factors of priorities, in units of 2^-31.
    /// Shares at the corners of faces, class by class; empty if all classes may lie everywhere.
    std::vector<float> shares;

    /// Returns the class that a random word stands for.
    std::uint32_t of(std::uint32_t random) const {
        std::uint32_t number = 0;
        while (number + 1 < count && random >= ends[number]) {
            ++number;
        }
        return number;
    }
};

/// A point of a face by the weights of its second and third corner.
template <class Real>
struct FacePoint {
    std::uint32_t face;
    Real weight1, weight2;
};

/// Owns the scaled half-edges; borrows fans and corners from the PreparedMesh.
template <class Real>
struct Surface {
    Frame frame; ///< Its unit is that of all lengths.
    std::vector<Edge<Real>> edges;
    std::span<const VertexFan> fans;
    std::span<const std::uint32_t> corners;
    /// True if each face has one cell for its candidates, whatever its size. Disks then test more
    /// of them.
    bool one_cell_each = false;
    /// By face, where radii vary, and in units of the frame; else empty, and all radii are half of
    /// it.
    std::vector<FaceRadii<Real>> radii;
    Classes<Real> classes; ///< Only where radii do not vary.

    Surface(const PreparedMesh& mesh, double min_distance);
    /// The same in the frame of a mesh of which this one is a part.
    Surface(const PreparedMesh& mesh, const Frame& frame_of_whole);
    /// The surface of a run, with its radii.
    Surface(const PreparedMesh& mesh, const SampleParams& params);
    /// The same in the frame of a mesh of which this one is a part.
    Surface(const PreparedMesh& mesh, const SampleParams& params, const Frame& frame_of_whole);

    std::uint32_t face_count() const { return static_cast<std::uint32_t>(edges.size() / 3); }
    bool is_adaptive() const { return !radii.empty(); }
    bool has_classes() const { return classes.count != 0; }
    /// The radius at a point, where radii vary.
    Real radius_at(FacePoint<Real> point) const;
    /// Cells of a face per unit of length, a power of two.
    Real cells_per_unit(std::uint32_t face) const {
        if (!is_adaptive() && !has_classes()) {
            return static_cast<Real>(gpu::kCellsPerDistance);
        }
        const Real largest =
            is_adaptive() ? radii[face].largest()
                          : *std::min_element(classes.reach, classes.reach + classes.count) / 2;
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(largest));
        return static_cast<Real>(std::bit_cast<float>(0x7f000000u - (bits & 0x7f800000u)));
    }

  private:
    void place_edges(const PreparedMesh& mesh);
    void set_classes(std::span<const float> factors);
};

/// Lengths in units of about the distance looked for keep all numbers in bounds, unless that is out
/// of all proportion to the mesh. A unit for it, in mesh units, for which the grids of the faces
/// have no more cells than so many.
double suitable_unit(const PreparedMesh& mesh, double distance, double max_cells);

/// No shortest path is longer, in mesh units: it meets each edge and each triangle at most once.
double longest_path(const PreparedMesh& mesh);

} // namespace geodisk::ref
