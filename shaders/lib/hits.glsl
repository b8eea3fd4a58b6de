// Records what a disk reaches: a HitRec for each path found to a vertex, or to a candidate if kScans.
#ifndef GEODISK_HITS_GLSL
#define GEODISK_HITS_GLSL

#include "job.glsl"
#include "operation.glsl"
#include "recorded.glsl"

layout(constant_id = kSpecPoints) const bool kScans = false;

// Returns a word of the candidates' weights, two each.
uint weight_word(uint at) { return recorded[1u + (at >> 2)][at & 3u]; }

void note_hit(uint target, float distance) {
    uint at = count_record();
    if (has_room(at)) {
        recorded[record_row(at, 1u)] =
            uvec4(control.next_sample + lane.slot, target, floatBitsToUint(distance), 0u);
    }
}

// The disk has found a path to a vertex that is shorter than those before.
void note_reached(uint vertex, float distance) {
    if (!kScans) {
        note_hit(vertex, distance);
    }
}

// The operation in flight lights a candidate at this squared distance from its source.
void note_conflict(uint place, bool is_active, bool conflicts, float square) {
    precise float distance = lane.sigma + root(square);
    if (conflicts) {
        note_hit(place, distance);
    }
}

#endif
