// Radii of a surface of which no process holds the whole.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"

namespace geodisk {

/// Values of a RadiusField at vertices instead of half-edges.
struct VertexRadii {
    std::vector<float> factors, spreads;
    std::vector<float> packing; ///< Empty for factors.

    static VertexRadii of_factors(std::vector<float> factors);
    /// Takes a density and the packing, in units of the smallest packing.
    static VertexRadii of_density(std::vector<float> density, std::vector<float> packing);
};

/// Integrand of RadiusField::effective_area() over a face: its mean is `sum / count`.
struct FaceMean {
    double sum, count;

    /// Returns the integral as the field of a whole mesh has it.
    double over(double area) const { return area * sum / count; }
    /// Returns RadiusField::samples_in().
    double samples() const { return sum / count; }
};

/// Summary of the radii over a whole surface.
struct RadiusTotals {
    double effective_area = 0, min_density = 0;
    float largest_density = 0, min_factor = 1;
};

struct RadiusPieces {
    /// Takes what radii are over the next face.
    using Visit = std::function<void(FaceMean mean)>;

    /// Returns the field on faces of three vertices each, without their areas. Calls `visit` for
    /// each face in order. Throws std::bad_alloc, as do the others.
    static RadiusField on_faces(std::span<const std::uint32_t> triangles, const VertexRadii& radii,
                                const Visit& visit);
    /// The same for the faces of half-edges.
    static RadiusField on_faces(std::span<const HalfEdge> edges, const VertexRadii& radii,
                                const Visit& visit);

    /// Returns the factors on faces alone, to find radii by.
    GEODISK_API static RadiusField factors_on(std::span<const std::uint32_t> triangles,
                                              const VertexRadii& radii);

    /// Returns a field without faces.
    static RadiusField outline(const RadiusTotals& totals);

    /// Returns RadiusField::on_part() of the whole for a piece of its mesh, to the bit.
    static RadiusField piece(const PreparedMesh& mesh, const VertexRadii& radii,
                             const RadiusField& outline);

  private:
    template <class VertexOf>
    static RadiusField at_corners(std::size_t corners, const VertexOf& vertex_of,
                                  const VertexRadii& radii);
    static void add_faces(RadiusField& field, const Visit& visit);
};

} // namespace geodisk
