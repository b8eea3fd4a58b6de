// Reach of disks with varying radii (paper section 5.8 cuts every disk at r(p) + r_max).
//
// Let U(x) be the largest r(q) - d(x, q) over all points q of the surface. A path from p of length
// l to x can only reach a conflicting point if l < r(p) + U(x). So a disk may be cut there without
// losing anything. U is the smallest function above r with a slope of at most 1. Therefore any
// function V >= r that is linear in each face with a gradient of at most 1 is an upper bound of U.
// Such a V is made by raising r at vertices; where g changes slowly, nothing is raised. Only
// lengths within faces matter, so this works for every surface that geodisk accepts.
#include "geodisk/radius_field.hpp"

#include <algorithm>
#include <utility>

#include "mesh/slopes.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

// Padding for the rounding of distances and radii on the device, see host/docs/precision.md.
constexpr double kPadding = 0x1p-15;

} // namespace

Result<std::vector<float>> RadiusField::reach_bounds(const PreparedMesh& mesh,
                                                     double min_distance) const noexcept {
    return guarded([&]() -> Result<std::vector<float>> {
        std::vector<double> radii(mesh.vertex_count(), 0.0);
        for (std::size_t h = 0; h < factors_.size(); ++h) {
            // Ignored faces have no lengths.
            if (mesh.half_edges()[h].length > 0) {
                radii[mesh.half_edges()[h].origin] = 0.5 * static_cast<double>(factors_[h]);
            }
        }
        const std::vector<double> values = raised_to_slope(mesh, min_distance, std::move(radii));
        std::vector<float> bounds(mesh.face_count());
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const auto at = [&](std::uint32_t k) {
                return values[mesh.half_edges()[std::size_t{3} * f + k].origin];
            };
            bounds[f] = static_cast<float>(std::max({at(0), at(1), at(2)}) + kPadding);
        }
        return bounds;
    });
}

} // namespace geodisk
