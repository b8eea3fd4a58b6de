// How a disk is completed: what it does to active candidates in it, and to the batch.
#ifndef GEODISK_COMPLETE_GLSL
#define GEODISK_COMPLETE_GLSL

#include "slots.glsl"

// Counts the candidate with these sample words among the blocks of the one at this place, if that is
// active and behind it.
void block(uvec4 own, uint place) {
    uint other = word_at(orders, place);
    if (is_slot_of(other, place) && is_before(own, sample_of(other))) {
        atomicAdd(slots[other].blocks, 1u);
    }
}

// Whoever completes the last disk spares the batch further dispatches.
void complete_one() {
    if (atomicAdd(control.incomplete, 0xffffffffu) == 1u) {
        control.detect_x = 0u;
    }
}

#endif
