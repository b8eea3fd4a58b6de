// Colours, all in linear light, that people of any colour vision can tell apart: those of Okabe and
// Ito (2008) for kinds, and one that grows in lightness for amounts. Also for GLSL ES 3.00, where a
// `const` is one at compile time.

vec3 from_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

vec3 to_srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

const vec3 kBare = vec3(0.81, 0.80, 0.77);
const vec3 kMark = vec3(0.012, 0.016, 0.03);
const vec3 kBlue = vec3(0.0, 0.168, 0.445);     // #0072b2
const vec3 kSky = vec3(0.093, 0.456, 0.815);    // #56b4e9
const vec3 kOverlap = vec3(0.665, 0.112, 0.0);  // #d55e00

// Returns the colour of samples of a kind above 0 (SampleRec).
vec3 class_color(uint kind) {
    const vec3 classes[8] = vec3[](
#include "class_colors.h"
    );
    return from_srgb(classes[(kind - 1u) % 8u]);
}

// At so many radii from the centre of its disk: a point in the middle, light around it, a rim.
vec3 disk_color(float q, uint kind) {
    if (q < 0.13) {
        return kMark;
    }
    if (kind == 0u) {
        return q > 0.93 ? kBlue : mix(vec3(0.42, 0.70, 0.92), kSky, q * q);
    }
    vec3 own = class_color(kind);
    return q > 0.93 ? 0.5 * own : mix(mix(own, vec3(0.9), 0.35), own, q * q);
}

// One of many for the cells of neighbours, or a shade of the colour of the sample's class.
vec3 cell_color(uint number, uint kind) {
    const vec3 kinds[7] = vec3[](vec3(0.79, 0.34, 0.0), vec3(0.093, 0.456, 0.815),
                                 vec3(0.0, 0.342, 0.171), vec3(0.871, 0.776, 0.054),
                                 vec3(0.0, 0.168, 0.445), vec3(0.665, 0.112, 0.0),
                                 vec3(0.604, 0.19, 0.386));
    float light = 0.35 + 0.11 * float((number >> 8) % 4u);
    vec3 own = kind == 0u ? kinds[number % 7u] : class_color(kind);
    return mix(own, vec3(0.9), kind == 0u ? light : light - 0.25);
}

// From 0, dark, to 1, light.
vec3 scale_color(float t) {
    const vec3 knots[7] = vec3[](
#include "scale_knots.h"
    );
    float at = clamp(t, 0.0, 1.0) * 6.0;
    uint i = min(uint(at), 5u);
    return from_srgb(mix(knots[i], knots[i + 1u], at - float(i)));
}

// Light at the sample, with a line at each half radius; where another sample would have room it is
// told by colour.
vec3 distance_color(float q) {
    if (q < 0.08) {
        return kMark;
    }
    if (q >= 2.0) {
        return kOverlap;
    }
    float line = abs(fract(2.0 * q + 0.5) - 0.5);
    return scale_color(1.0 - 0.5 * q) * (line < 0.05 ? 0.55 : 1.0);
}

// From 0, light, to 1, dark, with a line at each twentieth.
vec3 lined_color(float t) {
    float line = abs(fract(20.0 * t + 0.5) - 0.5);
    return scale_color(1.0 - t) * (line < 0.06 ? 0.45 : 1.0);
}

// Light from one side, from above, and a little from the eye.
vec3 shade(vec3 matte, vec3 normal, vec3 to_eye, vec3 to_light) {
    float key = max(dot(normal, to_light), 0.0);
    float head = max(dot(normal, to_eye), 0.0);
    vec3 halfway = normalize(to_light + to_eye);
    float gloss = 0.06 * pow(max(dot(normal, halfway), 0.0), 40.0);
    return min(matte * (0.22 + 0.68 * key + 0.22 * head) + gloss, vec3(1));
}
