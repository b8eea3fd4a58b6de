// What every active candidate starts with, whatever is sampled.
#ifndef GEODISK_READY_SLOT_GLSL
#define GEODISK_READY_SLOT_GLSL

GEODISK_BUFFER(kBindStates, , uint, states);
GEODISK_WORDS(kBindPlaces, places);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);
GEODISK_CONTROL;

// Whether select has filled the slot and it is not readied yet.
bool is_due(uint slot) {
    return slot < control.slots_used && slots[slot * kSlotRows].y == kSlotSelected;
}

// Whether this is the rank of a sample of an earlier chunk: it wraps around from below zero.
bool is_settled(uint rank) { return rank >= push.candidates; }

uint rank_of(uint slot) { return slots[slot * kSlotRows + 1u].x; }

// `candidate` becomes the row that begins with the rank. A sample of an earlier chunk has no place.
void ready_slot(uint slot, uvec4 candidate) {
    uint row = slot * kSlotRows;
    bool settled = is_settled(candidate.x);
    uint place = kNoPlace;
    if (!settled) {
        place = word_at(places, candidate.x);
    }
    slots[row] = uvec4(place, kSlotReady, 0u, 0u);
    slots[row + 1u] = candidate;
    slots[row + 2u] = uvec4(0u);
    slots[row + 3u] = uvec4(0u);
    blockers[slot] = 0u;
    if (!settled) {
        marks[place] = slot;
        states[place] |= kActive;
    }
}

#endif
