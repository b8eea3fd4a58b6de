// Barycentric weights are multiples of 2^-24, kept as integers.
#ifndef GEODISK_WEIGHTS_GLSL
#define GEODISK_WEIGHTS_GLSL

const uint kOneWeight = 16777216u;

float weight_of(uint steps) {
    precise float weight = float(steps) * 5.9604645e-8;
    return weight;
}

uint steps_of(float weight) {
    precise float steps = weight * float(kOneWeight);
    return uint(steps);
}

#endif
