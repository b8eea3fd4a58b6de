// A density at vertices and in faces, in units of the smallest packing: see density_field.cpp.
#pragma once

namespace geodisk {

/// The unit of a density.
struct DensityUnit {
    double most = 0; ///< Maximum density.
    double unit = 1; ///< Smallest packing, as a part of it.

    /// Returns the unit for a density of which this is the maximum, and the minimum above 0.
    static DensityUnit of(double most, double least);

    double min_density() const { return most * unit; }
    /// Returns a density in this unit; 0 for one that is too small to count.
    float scaled(double density) const;
};

/// Returns the packing that a vertex needs by its density.
float packing_of_vertex(float density);
/// Returns the packing that the corners of a face need by the maximum of their densities.
float packing_in_face(float most);

/// Returns the mean density of candidates over a face, by density and packing at its corners.
double mean_candidates(const float* density, const float* packing);

} // namespace geodisk
