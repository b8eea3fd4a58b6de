#version 450
#extension GL_GOOGLE_include_directive : require
// Selects the next batch on a surface.
// reads: weights, starts, samples   writes: orders, list, control, slots
// spec: slot local size, classes

#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/units.glsl"
#include "../lib/weights.glsl"
#include "../lib/class_bits.glsl"

GEODISK_WORDS(kBindWeights, weights);

// Declared for select_idle.glsl.
uvec4 sample_at(uint place, uint order);
void settle_point(uint slot, uvec4 record);

#include "../lib/select_idle.glsl"

void settle_point(uint slot, uvec4 record) {
    if ((record.y & kKeepsOut) != 0u) {
        slots[slot].face = record.y & ~kKeepsOut;
        slots[slot].turn = record.x;
        if (kClasses) {
            uint weight_bits = (1u << kKeptClassShift) - 1u;
            slots[slot].weight1 = record.z & weight_bits;
            slots[slot].weight2 = record.w & weight_bits;
            slots[slot].order = (record.z >> kKeptClassShift) << 2 | record.w >> kKeptClassShift;
        }
    }
}

uvec4 sample_at(uint place, uint order) {
    float weight1 = weight_of(weight_in(word_at(weights, 2u * place)));
    float weight2 = weight_of(word_at(weights, 2u * place + 1u));
    return uvec4(order, find_unit(place).owner, floatBitsToUint(weight1), floatBitsToUint(weight2));
}
