// Records what a disk reaches: a HitRec for each path found to a vertex, or to a candidate if kScans. They are
// behind a row with their number, the room for them and the row where they begin, and the weights of the
// candidates. More than there is room for are counted alone.
#ifndef GEODISK_HITS_GLSL
#define GEODISK_HITS_GLSL

#include "job.glsl"
#include "operation.glsl"

layout(set = 0, binding = kBindWeights, std430) coherent buffer hits_buffer { uvec4 hits[]; };

layout(constant_id = kSpecPoints) const bool kScans = false;

// Returns a word of the candidates' weights, two each.
uint weight_word(uint at) { return hits[1u + (at >> 2)][at & 3u]; }

void note_hit(uint target, float distance) {
    uint at = atomicAdd(hits[0].x, 1u);
    if (at >= kMostRecorded) {
        atomicAdd(hits[0].x, 0xffffffffu);
    }
    if (at < hits[0].y) {
        hits[hits[0].z + at] =
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
