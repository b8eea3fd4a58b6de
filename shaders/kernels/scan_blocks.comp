#version 450
#extension GL_GOOGLE_include_directive : require
// First step of an exclusive scan in place: each work group scans one block of kScanBlock words and
// leaves its sum.
// reads, writes: marks (any buffer bound there), sums

#include "../lib/prelude.glsl"
#include "../lib/group_scan.glsl"

layout(local_size_x = 128) in;

GEODISK_BUFFER(kBindMarks, , uint, words);
GEODISK_BUFFER(kBindSums, writeonly, uint, sums);

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint begin = min(block * kScanBlock + lane * kScanPerLane, push.scan_count);
    uint end = min(begin + kScanPerLane, push.scan_count);
    uint own = 0u;
    for (uint i = begin; i < end; ++i) {
        own += words[i];
    }
    uint total;
    uint before = group_exclusive_scan(lane, own, total);
    for (uint i = begin; i < end; ++i) {
        uint word = words[i];
        words[i] = before;
        before += word;
    }
    if (lane == 0u && block * kScanBlock < push.scan_count) {
        sums[block] = total;
    }
}
