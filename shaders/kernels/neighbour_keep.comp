#version 450
#extension GL_GOOGLE_include_directive : require
// Tells which entries stay: the shortest of each number, and of those the nearest ones. One invocation per
// entry, and one for the end.
// reads: entries, rows   writes: places   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour.glsl"

GEODISK_BUFFER(kBindRows, readonly, uint, rows);
GEODISK_BUFFER(kBindEntries, readonly, uvec4, entries);
GEODISK_BUFFER(kBindPlaces, writeonly, uint, places);

bool stays(uint index) {
    uvec4 own = entries[index];
    uint row = rows[own.x];
    if (push.nearest != 0u) {
        return own.z != kDropped && index - row < push.nearest;
    }
    return index == row || entries[index - 1u].y != own.y;
}

void main() {
    uint index = own_index();
    if (index < push.count) {
        places[index] = stays(index) ? 1u : 0u;
    } else if (index == push.count) {
        places[index] = 0u;
    }
}
