#version 450
#extension GL_GOOGLE_include_directive : require
// Forgets the active batch, whose slices overflowed: its candidates are idle again and will be
// selected with larger slices. Nothing was decided. One invocation per slot.
// reads: slots   writes: states, control   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, , uint, states);
GEODISK_ROWS(kBindSlots, slots);
GEODISK_CONTROL;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot < control.slots_used) {
        uint place = row_at(slots, slot * kSlotRows).x;
        if (place != kNoPlace) {
            states[place] &= ~kStateMask;
        }
    }
    if (slot == 0u) {
        control.next_rank = control.batch_rank;
        control.next_sample = control.batch_sample;
        control.unfinished = 0u;
        control.undecided = 0u;
        control.overflow = 0u;
        control.groups_x = 0u;
        control.detect_x = 0u;
    }
}
