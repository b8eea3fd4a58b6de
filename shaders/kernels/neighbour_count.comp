#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the entries of each source, and finds the most that one has. One invocation per hit.
// reads: weights (hits), names, limits   writes: rows   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour_hits.glsl"

shared uint group_longest;

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        group_longest = 0u;
    }
    barrier();
    uint index = own_index();
    if (index < push.count) {
        Hit hit = hit_at(index);
        uint entries = entries_of(hit);
        // Rows start one word later, like cells, see bin.comp.
        uint before = atomicAdd(rows[hit.source + 1u], entries);
        atomicMax(group_longest, before + entries);
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        atomicMax(rows[push.longest_word], group_longest);
    }
}
