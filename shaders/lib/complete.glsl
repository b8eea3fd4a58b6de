// Completion of a disk: its effect on active candidates in it, and on the batch.
#ifndef GEODISK_COMPLETE_GLSL
#define GEODISK_COMPLETE_GLSL

#include "slots.glsl"

#if !defined(GEODISK_LIGHT) && !defined(GEODISK_REACH)
// Adds a block of the candidate with these sample words to the one at this place, if that is active and
// comes after it.
void block(uvec4 own, uint place) {
    uint other = word_at(orders, place);
    if (is_slot_of(other, place) && is_before(own, sample_of(other))) {
        atomicAdd(slots[other].blocks, 1u);
    }
}
#endif

// The invocation that completes the last disk ends further dispatches of the batch.
void complete_one() {
    if (atomicAdd(control.incomplete, 0xffffffffu) == 1u) {
        control.detect_x = 0u;
        control.large_x = 0u;
    }
}

#endif
