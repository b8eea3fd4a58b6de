// Length of a curve between two points whose normals turn evenly along it (Bowers, Wang, Wei and Maletz
// 2010): d * (asin(from) - asin(to)) / (from - to), where d is the straight distance, and from and to
// are the cosines of its angles with both normals.
#ifndef GEODISK_CURVE_GLSL
#define GEODISK_CURVE_GLSL

#include "rounding.glsl"

// Returns a / b for |a| <= b, correctly rounded.
float signed_ratio(float a, float b) {
    float magnitude = ratio(abs(a), b);
    return a < 0.0 ? -magnitude : magnitude;
}

float product3(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

// Returns the arc sine to 2^-23, by a polynomial (Cephes) up to a half, beyond that by the half angle.
float arcsine(float x) {
    float magnitude = abs(x);
    bool is_wide = magnitude > 0.5;
    precise float rest = 0.5 * (1.0 - magnitude);
    precise float magnitude2 = magnitude * magnitude;
    float s = is_wide ? root(rest) : magnitude;
    float z = is_wide ? rest : magnitude2;
    precise float series =
        (((4.2163199e-2 * z + 2.4181311e-2) * z + 4.5470026e-2) * z + 7.4953003e-2) * z +
        1.6666752e-1;
    precise float angle = series * z * s + s;
    precise float complement = 1.5707964 - 2.0 * angle;
    float result = is_wide ? complement : angle;
    return x < 0.0 ? -result : result;
}

// Returns true if the curve is shorter than a limit, given as a square; `square` is that of the straight
// line.
bool is_short_curve(vec3 way, float square, vec3 normal, vec3 other_normal, float limit2) {
    float straight = root(square);
    float from = signed_ratio(product3(normal, way), straight);
    float to = signed_ratio(product3(other_normal, way), straight);
    precise float apart = from - to;
    precise float middle = 0.5 * (from + to);
    // Limit of the quotient for equal angles, where it would lose digits.
    precise float flat_limit2 = limit2 * (1.0 - middle * middle);
    precise float angle = arcsine(from) - arcsine(to);
    precise float curve = straight * abs(angle);
    precise float limit = root(limit2) * abs(apart);
    return abs(apart) < kSameAngle ? square < flat_limit2 : curve < limit;
}

#endif
