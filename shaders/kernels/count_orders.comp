#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates up to control.counted_order, for an exact number of darts. Runs while none is
// active. kSelectBlock candidates per work group.
// reads: orders   writes: control

#include "../lib/prelude.glsl"
#include "../lib/job.glsl"

layout(local_size_x = kWideLanes) in;

GEODISK_WORDS(kBindOrders, orders);
GEODISK_CONTROL;

shared uint group_below;

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        group_below = 0u;
    }
    barrier();
    uint begin = own_group() * kSelectBlock;
    uint end = min(begin + kSelectBlock, min(control.drawn, job.capacity));
    uint highest = control.counted_order;
    uint below = 0u;
    for (uint place = begin + gl_LocalInvocationID.x; place < end; place += kWideLanes) {
        below += word_at(orders, place) <= highest ? 1u : 0u;
    }
    atomicAdd(group_below, below);
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        atomicAdd(control.below, group_below);
    }
}
