#version 450
#extension GL_GOOGLE_include_directive : require
// Goes on after the host has acted on an overflow. Of an active batch, whose slices overflowed,
// nothing was decided: its candidates are idle again and will be selected anew. One invocation per
// slot.
// writes: states, orders, slots, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, , uint, states);
GEODISK_BUFFER(kBindOrders, writeonly, uint, orders);
GEODISK_CONTROL;

#include "../lib/states.glsl"

void main() {
    uint slot = own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (slot < control.slots_used && slots[slot].place != kNoPlace) {
        uint place = slots[slot].place;
        atomicAnd(states[active_word(place)], ~state_bit(place));
        orders[place] = slots[slot].order;
    }
}
