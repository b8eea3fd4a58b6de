#version 450
#extension GL_GOOGLE_include_directive : require
// Third step: each work group scans one block of kScanBlock words, from the sum of the blocks before.
// reads: sums   writes: cells (or what is bound in their place)

#include "../lib/prelude.glsl"
#include "../lib/block_scan.glsl"

layout(local_size_x = kScanLanes) in;

GEODISK_WORDS_BEFORE(kBindCells, kBindCellsTexels, words);
GEODISK_WORDS(kBindSums, sums);

uint begin;
uint count; // of the block

uint read_word(uint i) { return i < count ? word_before(words, begin + i) : 0u; }

void write_word(uint i, uint word) {
    if (i < count) {
        words[begin + i] = word;
    }
}

void main() {
    uint block = own_group();
    begin = min(block * kScanBlock, push.scan_count);
    count = min(push.scan_count - begin, kScanBlock);
    block_exclusive_scan(gl_LocalInvocationID.x, count > 0u ? word_at(sums, block) : 0u);
}
