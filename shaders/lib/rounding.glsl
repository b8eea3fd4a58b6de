// Division and square root, correctly rounded on every device. Vulkan does not require this (2.5 ULP);
// only + - * under `precise` are exact. kNativeRounding uses the device's own if it is known to round
// correctly. Otherwise an approximation is corrected by its exact residual (Dekker 1971).
#ifndef GEODISK_ROUNDING_GLSL
#define GEODISK_ROUNDING_GLSL

#include "tolerances.glsl"

layout(constant_id = kSpecNativeRounding) const bool kNativeRounding = false;

// Returns the rounding error of a * b, which became `product`; exact, by Veltkamp's splitting.
float product_error(float a, float b, float product) {
    precise float a_big = 4097.0 * a;
    precise float a_high = a_big - (a_big - a);
    precise float a_low = a - a_high;
    precise float b_big = 4097.0 * b;
    precise float b_high = b_big - (b_big - b);
    precise float b_low = b - b_high;
    precise float error =
        ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return error;
}

// Returns x - a * b; exact if a * b is within a few units of the last place of x.
float residual(float x, float a, float b) {
    precise float product = a * b;
    precise float rest = (x - product) - product_error(a, b, product);
    return rest;
}

float next_up(float x) { return uintBitsToFloat(floatBitsToUint(x) + 1u); }
float next_down(float x) { return uintBitsToFloat(floatBitsToUint(x) - 1u); }

// Returns a / b for 2^-40 b <= a < b, b normal.
float rounded_quotient(float a, float b) {
    // Scale by the power of two that brings b into [1, 2): exact.
    float scale = uintBitsToFloat(0x7f000000u - (floatBitsToUint(b) & 0x7f800000u));
    precise float x = a * scale;
    precise float d = b * scale;
    precise float q = x / d;
    precise float correction = residual(x, q, d) / d;
    q = q + correction;
    float rest = residual(x, q, d);
    float up = next_up(q);
    float down = next_down(q);
    precise float above = (0.5 * (up - q)) * d;
    precise float below = (0.5 * (q - down)) * d;
    return rest > above ? up : (-rest > below ? down : q);
}

// Returns sqrt(x) for x > 2^-100, x normal.
float rounded_root(float x) {
    // Scale by an even power of two into [1, 4): exact.
    int exponent = (int(floatBitsToUint(x) >> 23) - 127) & ~1;
    precise float y = x * uintBitsToFloat(uint(127 - exponent) << 23);
    precise float s = sqrt(y);
    precise float correction = 0.5 * residual(y, s, s) / s;
    s = s + correction;
    float rest = residual(y, s, s);
    float up = next_up(s);
    float down = next_down(s);
    precise float above = s * (up - s);
    precise float below = -(s * (s - down));
    s = rest > above ? up : (rest <= below ? down : s);
    precise float result = s * uintBitsToFloat(uint(127 + exponent / 2) << 23);
    return result;
}

// Returns a / b clamped to [0, 1], for a >= 0; 1 if b is too small or negative, 0 if a is negligible.
float ratio(float a, float b) {
    precise float least = b * kSmallestRatio;
    float quotient = kNativeRounding ? a / b : rounded_quotient(a, b);
    return a <= least || a == 0.0 ? 0.0 : (a >= b ? 1.0 : quotient);
}

float root(float x) {
    float result = kNativeRounding ? sqrt(x) : rounded_root(x);
    return x <= kSmallestSquare ? 0.0 : result;
}

#endif
