#version 450
#extension GL_GOOGLE_include_directive : require
// Prepares select again after rewind. One invocation.
// writes: control   spec: slot local size

#include "../lib/prelude.glsl"

layout(local_size_x = 1) in;

GEODISK_CONTROL;

#include "../lib/schedule.glsl"

void main() {
    control.undecided = 0u;
    control.overflow = 0u;
    if (control.mode == kSelectPool) {
        control.list_end = 0u; // The list may be incomplete.
    }
    if (control.done == 0u) {
        prepare_select();
    }
}
