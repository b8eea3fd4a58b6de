#version 450
#extension GL_GOOGLE_include_directive : require
// Third step: every word gains the sum of the blocks before its own.
// reads: sums   writes: cells (or what is bound in their place)

#include "../lib/prelude.glsl"

layout(local_size_x = 128) in;

GEODISK_BUFFER(kBindCells, , uint, words);
GEODISK_WORDS(kBindSums, sums);

void main() {
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (block * kScanBlock >= push.scan_count) {
        return;
    }
    uint before = word_at(sums, block);
    uint end = min((block + 1u) * kScanBlock, push.scan_count);
    for (uint i = block * kScanBlock + gl_LocalInvocationID.x; i < end; i += kScanLanes) {
        words[i] += before;
    }
}
