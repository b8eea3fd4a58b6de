#version 450
#extension GL_GOOGLE_include_directive : require
// Drops the candidates that are no darts (kNoDart) before the first batch: nothing conflicts with them, and
// they are never selected. One invocation per 32 candidates.
// reads: weights   writes: orders, control

#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/states.glsl"

layout(local_size_x = kWideLanes) in;

GEODISK_WORDS(kBindWeights, weights);
GEODISK_BUFFER(kBindOrders, , uint, orders);
GEODISK_CONTROL;

void main() {
    uint first = 32u * (own_group() * kWideLanes + gl_LocalInvocationID.x);
    uint end = min(first + 32u, control.drawn > job.capacity ? 0u : control.drawn);
    uint dropped = 0u;
    for (uint place = first; place < end; ++place) {
        dropped |= (word_at(weights, 2u * place) & kNoDart) != 0u ? state_bit(place) : 0u;
    }
    if (dropped != 0u) {
        orders[undecided_word(first)] &= ~dropped;
        atomicAdd(control.idle, 0u - uint(bitCount(dropped)));
    }
}
