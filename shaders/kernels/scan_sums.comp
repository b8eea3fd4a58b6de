#version 450
#extension GL_GOOGLE_include_directive : require
// Second step: one work group scans the block sums, a block of them at a time.
// reads, writes: sums

#include "../lib/prelude.glsl"
#include "../lib/group_scan.glsl"

layout(local_size_x = 128) in;

GEODISK_BUFFER(kBindSums, , uint, sums);

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint count = (push.scan_count + kScanBlock - 1u) / kScanBlock;
    uint carry = 0u;
    for (uint first = 0u; first < count; first += kScanBlock) {
        uint begin = min(first + lane * kScanPerLane, count);
        uint end = min(begin + kScanPerLane, count);
        uint own = 0u;
        for (uint i = begin; i < end; ++i) {
            own += sums[i];
        }
        uint total;
        uint before = carry + group_exclusive_scan(lane, own, total);
        for (uint i = begin; i < end; ++i) {
            uint sum = sums[i];
            sums[i] = before;
            before += sum;
        }
        carry += total;
    }
}
