#version 450
#extension GL_GOOGLE_include_directive : require
// Checks the arithmetic that decisions depend on: + - * round to nearest and stay separate under
// `precise`, and division and root are correctly rounded. Each invocation replaces four operands by four
// results; the host compares bits.
// reads, writes: sums (four words per invocation)   spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/rounding.glsl"

layout(local_size_x_id = 0) in; // kSpecLocalSize

GEODISK_BUFFER(kBindSums, , uvec4, vectors);

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.scan_count) {
        return;
    }
    vec4 operands = uintBitsToFloat(vectors[i]);
    precise float fused = operands.x * operands.y + operands.z;
    precise float cancelled = (operands.z + operands.x) - operands.z;
    vectors[i] = floatBitsToUint(
        vec4(ratio(operands.x, operands.y), root(operands.w), fused, cancelled));
}
