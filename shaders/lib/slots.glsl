// Slots, as the candidates in them are compared and looked up.
#ifndef GEODISK_SLOTS_GLSL
#define GEODISK_SLOTS_GLSL

#include "dart_order.glsl"

uvec4 sample_of(uint slot) {
    return uvec4(slots[slot].order, slots[slot].face, slots[slot].weight1, slots[slot].weight2);
}

// Slots were given in any order, so that some may hold candidates above one that found none: such
// are not active.
bool is_void(uint slot) {
    return slots[slot].place != kNoPlace && slots[slot].order >= control.first_left;
}

// Whether an order word, which of an active candidate is its slot, names the slot of this place.
bool is_slot_of(uint slot, uint place) {
    return slot < control.slots_used && slots[slot].place == place && !is_void(slot);
}

#endif
