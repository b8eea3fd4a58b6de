#version 450
#extension GL_GOOGLE_include_directive : require
// Drops entries of a number that has a shorter one, in rows that are in the order of their numbers. One
// invocation per entry.
// reads, writes: entries   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour.glsl"

GEODISK_BUFFER(kBindEntries, coherent, NeighbourRec, entries);

void main() {
    uint index = own_index();
    if (index > 0u && index < push.count && entries[index - 1u].source == entries[index].source &&
        entries[index - 1u].number == entries[index].number) {
        entries[index].distance = kDropped; // No other invocation reads it.
    }
}
