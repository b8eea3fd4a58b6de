// Radii of a surface of which no process holds the whole.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"

namespace geodisk {

/// What RadiusField has at half-edges, at vertices.
struct VertexRadii {
    std::vector<float> factors, spreads;
    std::vector<float> packing; ///< Empty for factors.

    static VertexRadii of_factors(std::vector<float> factors);
    /// Takes a density and the packing, in units of the smallest packing.
    static VertexRadii of_density(std::vector<float> density, std::vector<float> packing);
};

/// What RadiusField::effective_area() integrates, over a face: its mean is `sum / count`.
struct FaceMean {
    double sum, count;

    double over(double area) const { return area * sum / count; }
};

/// What radii are over a whole surface.
struct RadiusTotals {
    double effective_area = 0, least_density = 0;
    float largest_density = 0, least_factor = 1;
};

struct RadiusPieces {
    using Visit = std::function<void(FaceMean mean)>;

    /// Returns the field on faces of three vertices each, without their areas. Calls `visit` for
    /// each face in order. Throws std::bad_alloc, as do the others.
    static RadiusField on_faces(std::span<const std::uint32_t> triangles, const VertexRadii& radii,
                                const Visit& visit);

    /// Returns a field without faces.
    static RadiusField outline(const RadiusTotals& totals);

    /// Returns RadiusField::on_part() of the whole for a piece of its mesh, to the bit.
    static RadiusField piece(const PreparedMesh& mesh, const VertexRadii& radii,
                             const RadiusField& outline);
};

} // namespace geodisk
