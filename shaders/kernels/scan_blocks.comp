#version 450
#extension GL_GOOGLE_include_directive : require
// Third step: each work group scans one block of kScanBlock words, from the sum of the blocks before.
// reads: sums   writes: cells (or what is bound in their place)

#include "../lib/prelude.glsl"
#include "../lib/block_scan.glsl"

layout(local_size_x = 128) in;

GEODISK_WORDS_BEFORE(kBindCells, kBindCellsTexels, words);
GEODISK_WORDS(kBindSums, sums);

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint block = own_group();
    uint begin = min(block * kScanBlock, push.scan_count);
    uint count = min(push.scan_count - begin, kScanBlock);
    for (uint k = 0u; k < kScanPerLane; ++k) {
        uint i = k * kScanLanes + lane;
        block_words[block_index(i)] = i < count ? word_before(words, begin + i) : 0u;
    }
    block_exclusive_scan(lane, count > 0u ? word_at(sums, block) : 0u);
    for (uint i = lane; i < count; i += kScanLanes) {
        words[begin + i] = block_words[block_index(i)];
    }
}
