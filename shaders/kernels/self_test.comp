#version 450
#extension GL_GOOGLE_include_directive : require
// Checks on fixed vectors that the device keeps the promises decisions rest on: + - * round to
// nearest and stay separate under `precise`, and division and root come out correctly rounded. Each
// invocation derives operands from its index and writes what it computed; the host compares bits.
// writes: sums (four words per invocation)   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/rng.glsl"
#include "../lib/rounding.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindSums, writeonly, uint, results);

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.candidates) {
        return;
    }
    uvec4 random = philox(uvec2(push.seed_low, push.seed_high), i);
    // Mantissas at random, exponents within the range decisions use.
    float a = uintBitsToFloat((random.x & 0x007fffffu) | (107u + random.w % 20u) << 23);
    float b = uintBitsToFloat((random.y & 0x007fffffu) | 127u << 23);
    float c = uintBitsToFloat((random.z & 0x007fffffu) | (117u + (random.w >> 8) % 20u) << 23);
    precise float fused = a * b + c;
    precise float cancelled = (c + a) - c;
    results[4u * i] = floatBitsToUint(ratio(a, b));
    precise float product = a * b;
    results[4u * i + 1u] = floatBitsToUint(root(product));
    results[4u * i + 2u] = floatBitsToUint(fused);
    results[4u * i + 3u] = floatBitsToUint(cancelled);
}
