#version 450
#extension GL_GOOGLE_include_directive : require
// Appends the entries that stay to the caller's lists, and tells where those of each source begin. Where there
// is no room, it only tells how much there should be. One invocation per entry or source.
// reads: entries, rows, places   writes: offsets, targets, distances   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour.glsl"

GEODISK_BUFFER(kBindRows, readonly, uint, rows);
GEODISK_BUFFER(kBindEntries, readonly, uvec4, entries);
GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindOffsets, coherent, uint, offsets);
GEODISK_BUFFER(kBindTargets, writeonly, uint, targets);
GEODISK_BUFFER(kBindDistances, writeonly, uint, distances);

void main() {
    uint index = own_index();
    uint first = offsets[push.first_source]; // No invocation writes it.
    if (index < push.count && places[index + 1u] > places[index]) {
        uint at = first + places[index];
        if (at < push.pairs) {
            targets[at] = entries[index].y;
            distances[at] = entries[index].z;
        }
    }
    if (index < push.sources) {
        offsets[push.first_source + index + 1u] = first + places[rows[index + 1u]];
    }
    if (index == 0u && first + places[push.count] <= push.pairs) {
        offsets[push.all_sources + 1u] = push.first_source + push.sources;
    }
}
