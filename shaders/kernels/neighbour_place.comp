#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the entries of each source to its row, in some order. One invocation per hit.
// reads: weights (hits), names, limits   writes: rows, entries   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour_hits.glsl"

GEODISK_BUFFER(kBindEntries, writeonly, uvec4, entries);

void main() {
    uint index = own_index();
    if (index >= push.count) {
        return;
    }
    Hit hit = hit_at(index);
    uint count = entries_of(hit);
    uint first = atomicAdd(rows[hit.source + 1u], count);
    for (uint i = 0u; i < count; ++i) {
        if (first + i < push.capacity) {
            entries[first + i] = uvec4(hit.source, number_of(hit, hit.first + i), hit.distance, 0u);
        }
    }
}
