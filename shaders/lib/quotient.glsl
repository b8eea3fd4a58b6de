// Division of many numbers by one, as a product whose error is at most 1: lavapipe divides lane by lane.
#ifndef GEODISK_QUOTIENT_GLSL
#define GEODISK_QUOTIENT_GLSL

uint inverse_of(uint divisor) { return 0xffffffffu / divisor; }

uint quotient(uint x, uint divisor, uint inverse) {
    uint result, low;
    umulExtended(x, inverse, result, low);
    return x - result * divisor >= divisor ? result + 1u : result;
}

#endif
