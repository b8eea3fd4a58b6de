#version 450
#extension GL_GOOGLE_include_directive : require
// Merges runs of push.width entries of each row, two at a time: each entry finds its place by the number of
// entries of the other run that come before it. One invocation per entry.
// reads: entries, rows   writes: sorted   spec: local size

#define GEODISK_OWN_PUSH NeighbourPush
#include "../lib/prelude.glsl"
#include "../lib/neighbour.glsl"

GEODISK_BUFFER(kBindRows, readonly, uint, rows);
GEODISK_BUFFER(kBindEntries, readonly, uvec4, entries);
GEODISK_BUFFER(kBindSorted, writeonly, uvec4, sorted);

const uint kMaxHalvings = 32u;

bool is_before(uvec4 a, uvec4 b) {
    uvec2 x = push.by_distance != 0u ? a.zy : a.yz;
    uvec2 y = push.by_distance != 0u ? b.zy : b.yz;
    return x.x < y.x || (x.x == y.x && x.y < y.y);
}

void main() {
    uint index = own_index();
    if (index >= push.count) {
        return;
    }
    uvec4 own = entries[index];
    uint row = rows[own.x];
    uint row_end = rows[own.x + 1u];
    uint run = (index - row) / push.width;
    bool is_second = (run & 1u) != 0u;
    uint other = min(row + (run ^ 1u) * push.width, row_end);
    uint low = other;
    uint high = min(other + push.width, row_end);
    // Equal ones of the first run come first.
    for (uint i = 0u; i < kMaxHalvings && low < high; ++i) {
        uint middle = low + (high - low) / 2u;
        uvec4 met = entries[middle];
        bool comes_before = is_second ? !is_before(own, met) : is_before(met, own);
        low = comes_before ? middle + 1u : low;
        high = comes_before ? high : middle;
    }
    uint begin = is_second ? index - push.width : index;
    sorted[begin + (low - other)] = own;
}
