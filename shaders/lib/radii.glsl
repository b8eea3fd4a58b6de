// Radii that vary over the surface (paper section 5.8), in units of the minimum distance, at most half:
// linear in each face, or 0.5 / sqrt(s) with the packing s linear. Kernels for one radius contain none
// of this. Needs rounding.glsl.
#ifndef GEODISK_RADII_GLSL
#define GEODISK_RADII_GLSL

#include "classes.glsl"
#include "fans.glsl"
#include "job.glsl"

layout(constant_id = kSpecAdaptive) const bool kAdaptive = false;

// Returns the first row after vertices, corners and angles: of radii, or of bounds if radii do not vary.
uint after_fans() {
    uint corners = 3u * job.faces;
    return job.vertices + ((corners + 1u) >> 1) + ((corners + 3u) >> 2);
}

// Returns a row of RadiiRec.
vec4 radii_row(uint face, uint row) {
    return uintBitsToFloat(row_at(fans, after_fans() + kRadiiRows * face + row));
}

// Returns, for a face, the radii of its corners, or their packing (negative), and how far disks reach
// into it.
vec4 face_radii(uint face) { return radii_row(face, 0u); }

// Returns what candidates are proposed by, and how much denser they are.
vec4 face_spreads(uint face) { return radii_row(face, 1u); }

// Interpolates linearly at the point with these weights of the second and third corner.
float interpolated(vec3 corners, float weight1, float weight2) {
    precise float weight0 = 1.0 - weight1 - weight2;
    precise float value = weight0 * corners.x + weight1 * corners.y + weight2 * corners.z;
    return value;
}

bool has_packing(vec4 radii) { return radii.x < 0.0; }

// Converts an interpolated value to a radius.
float radius_of_value(float value) { return value < 0.0 ? ratio(0.5, root(-value)) : value; }

float radius_at(vec4 radii, float weight1, float weight2) {
    return radius_of_value(interpolated(radii.xyz, weight1, weight2));
}

float largest_radius(vec4 radii) {
    return radius_of_value(max(radii.x, max(radii.y, radii.z)));
}

// Returns the cells per unit of length: a power of two, so that a cell is at most as wide as the largest
// radius of its face and more than half as wide. It is kCellsPerDistance for the largest radius of all.
float cells_per_unit(vec4 radii) {
    uint exponent = floatBitsToUint(largest_radius(radii)) & 0x7f800000u;
    float same = kClasses ? class_number(kClassCells) : float(kCellsPerDistance);
    return kAdaptive ? uintBitsToFloat(0x7f000000u - exponent) : same;
}

#endif
