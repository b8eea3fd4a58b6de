// Comparison and lookup of the candidates in slots.
#ifndef GEODISK_SLOTS_GLSL
#define GEODISK_SLOTS_GLSL

#include "dart_order.glsl"

uvec4 sample_of(uint slot) {
    return uvec4(slots[slot].order, slots[slot].face, slots[slot].weight1, slots[slot].weight2);
}

// Returns true if a slot is void. Slots are given in any order, so some may hold candidates above one
// that found none; these are not active.
bool is_void(uint slot) {
    return slots[slot].place != kNoPlace && slots[slot].order >= control.first_left;
}

// Returns true if an order word, which for an active candidate is its slot, names the slot of this
// place.
bool is_slot_of(uint slot, uint place) {
    return slot < control.slots_used && slots[slot].place == place && !is_void(slot);
}

#endif
