#version 450
#extension GL_GOOGLE_include_directive : require
// Readies the slots that select has filled with ranks; those of samples of earlier chunks have no
// place among the candidates. One invocation per slot.
// reads: alias columns, radii, places   writes: states, slots, marks, blockers
// spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, , uint, states);
GEODISK_WORDS(kBindPlaces, places);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);
GEODISK_CONTROL;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    uint row = slot * kSlotRows;
    if (slot >= control.slots_used || slots[row].y != kSlotSelected) {
        return;
    }
    uint rank = slots[row + 1u].x;
    bool settled = rank >= push.candidates;
    uint place = kNoPlace;
    if (!settled) {
        place = word_at(places, rank);
    }
    Candidate c = draw_candidate(rank);
    slots[row] = uvec4(place, kSlotReady, 0u, 0u);
    slots[row + 1u] = uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
                            floatBitsToUint(weight_of(c.weight2)));
    slots[row + 2u] = uvec4(0u);
    slots[row + 3u] = uvec4(0u);
    blockers[slot] = 0u;
    if (!settled) {
        marks[place] = slot;
        states[place] |= kActive;
    }
}
