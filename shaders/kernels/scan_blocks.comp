#version 450
#extension GL_GOOGLE_include_directive : require
// First step of an exclusive scan in place: each work group scans one block of kScanBlock words and
// leaves its sum.
// reads, writes: cells (or what is bound in their place), sums

#include "../lib/prelude.glsl"
#include "../lib/block_scan.glsl"

layout(local_size_x = 128) in;

GEODISK_BUFFER(kBindCells, , uint, words);
GEODISK_BUFFER(kBindSums, writeonly, uint, sums);

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint begin = min(block * kScanBlock, push.scan_count);
    uint count = min(push.scan_count - begin, kScanBlock);
    for (uint i = lane; i < kScanBlock; i += kScanLanes) {
        block_words[block_index(i)] = i < count ? words[begin + i] : 0u;
    }
    uint total = block_exclusive_scan(lane, 0u);
    for (uint i = lane; i < count; i += kScanLanes) {
        words[begin + i] = block_words[block_index(i)];
    }
    if (lane == 0u && count > 0u) {
        sums[block] = total;
    }
}
