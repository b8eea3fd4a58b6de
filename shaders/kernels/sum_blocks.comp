#version 450
#extension GL_GOOGLE_include_directive : require
// First step of an exclusive scan in place: each work group sums one block of kScanBlock words.
// reads: cells (or what is bound in their place)   writes: sums

#include "../lib/prelude.glsl"

layout(local_size_x = kScanLanes) in;

GEODISK_WORDS(kBindCells, words);
GEODISK_BUFFER(kBindSums, writeonly, uint, sums);

shared uint group_sum;

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint block = own_group();
    if (lane == 0u) {
        group_sum = 0u;
    }
    barrier();
    uint sum = 0u;
    for (uint k = 0u; k < kScanPerLane; ++k) {
        uint i = block * kScanBlock + k * kScanLanes + lane;
        sum += i < push.scan_count ? word_at(words, i) : 0u;
    }
    atomicAdd(group_sum, sum);
    barrier();
    if (lane == 0u && block * kScanBlock < push.scan_count) {
        sums[block] = group_sum;
    }
}
