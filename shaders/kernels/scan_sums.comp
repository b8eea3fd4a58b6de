#version 450
#extension GL_GOOGLE_include_directive : require
// Second step: one work group scans the block sums, a block of them at a time.
// reads, writes: sums

#include "../lib/prelude.glsl"
#include "../lib/block_scan.glsl"

layout(local_size_x = kScanLanes) in;

GEODISK_BUFFER(kBindSums, , uint, sums);

uint begin;
uint here; // of the block

uint read_word(uint i) { return i < here ? sums[begin + i] : 0u; }

void write_word(uint i, uint word) {
    if (i < here) {
        sums[begin + i] = word;
    }
}

void main() {
    uint count = (push.scan_count + kScanBlock - 1u) / kScanBlock;
    uint carry = 0u;
    for (begin = 0u; begin < count; begin += kScanBlock) {
        here = min(count - begin, kScanBlock);
        carry += block_exclusive_scan(gl_LocalInvocationID.x, carry);
    }
}
