#version 450
#extension GL_GOOGLE_include_directive : require
// Prepares select again after rewind, or where push.end_order has changed. Leaves a batch in progress
// and an overflow alone. One invocation.
// writes: control   spec: slot local size

#include "../lib/prelude.glsl"

layout(local_size_x = 1) in;

GEODISK_CONTROL;

#include "../lib/schedule.glsl"

void main() {
    if (control.slots_used != 0u || control.overflow != 0u) {
        return;
    }
    if (control.mode == kSelectPool) {
        control.list_end = 0u; // The list may be incomplete.
    }
    control.done = 0u;
    set_out_select(0u);
    go_on();
}
