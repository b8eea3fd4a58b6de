#version 450
#extension GL_GOOGLE_include_directive : require
// Undoes a batch after the host has handled an overflow. Nothing of it was decided: its candidates
// become idle again and will be selected again. One invocation per slot.
// writes: orders, slots, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 4) in; // kSpecSlotLocalSize

GEODISK_BUFFER(kBindOrders, , uint, orders);
GEODISK_CONTROL;

#include "../lib/states.glsl"

void main() {
    uint slot = own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (slot < control.slots_used && slots[slot].place != kNoPlace) {
        uint place = slots[slot].place;
        atomicAnd(orders[active_word(place)], ~state_bit(place));
        orders[place] = slots[slot].order;
    }
}
