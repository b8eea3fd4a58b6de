#version 450
#extension GL_GOOGLE_include_directive : require
// Second step: one work group scans the block sums, a block of them at a time.
// reads, writes: sums

#include "../lib/prelude.glsl"
#include "../lib/block_scan.glsl"

layout(local_size_x = 128) in;

GEODISK_BUFFER(kBindSums, , uint, sums);

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint count = (push.scan_count + kScanBlock - 1u) / kScanBlock;
    uint carry = 0u;
    for (uint begin = 0u; begin < count; begin += kScanBlock) {
        uint here = min(count - begin, kScanBlock);
        for (uint i = lane; i < kScanBlock; i += kScanLanes) {
            block_words[block_index(i)] = i < here ? sums[begin + i] : 0u;
        }
        carry += block_exclusive_scan(lane, carry);
        for (uint i = lane; i < here; i += kScanLanes) {
            sums[begin + i] = block_words[block_index(i)];
        }
        barrier();
    }
}
