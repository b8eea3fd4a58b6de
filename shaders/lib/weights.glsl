// Barycentric weights are multiples of 2^-24, kept as integers.
#ifndef GEODISK_WEIGHTS_GLSL
#define GEODISK_WEIGHTS_GLSL

float weight_of(uint steps) {
    precise float weight = float(steps) * 5.9604645e-8;
    return weight;
}

#endif
