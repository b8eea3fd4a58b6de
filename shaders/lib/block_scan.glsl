// Exclusive scan of a block of kScanBlock words by a work group. Lanes read and write rows of four
// words, neighbours side by side. Only the sums of rows go through shared memory, which gives each lane
// consecutive ones. Needs read_word(i), which returns a word of the block, and write_word(i, word).
#ifndef GEODISK_BLOCK_SCAN_GLSL
#define GEODISK_BLOCK_SCAN_GLSL

#include "group_scan.glsl"

const uint kRowWords = 4u;
const uint kRowsPerLane = kScanPerLane / kRowWords;
// A word is skipped after this many, so that lanes do not read from the same banks.
const uint kBanks = 32u;

shared uint row_sums[kScanLanes * kRowsPerLane + kScanLanes * kRowsPerLane / kBanks];

uint bank_index(uint row) { return row + row / kBanks; }

uint read_word(uint i);
void write_word(uint i, uint word);

// Scans the block. Every lane must call it. Returns the sum of all words; `before` is added to each.
uint block_exclusive_scan(uint lane, uint before) {
    uint own_words[kScanPerLane];
    for (uint k = 0u; k < kRowsPerLane; ++k) {
        uint row = k * kScanLanes + lane;
        uint sum = 0u;
        for (uint j = 0u; j < kRowWords; ++j) {
            uint word = read_word(row * kRowWords + j);
            own_words[k * kRowWords + j] = word;
            sum += word;
        }
        row_sums[bank_index(row)] = sum;
    }
    barrier();
    uint own_sums[kRowsPerLane];
    uint own = 0u;
    for (uint k = 0u; k < kRowsPerLane; ++k) {
        own_sums[k] = row_sums[bank_index(lane * kRowsPerLane + k)];
        own += own_sums[k];
    }
    uint total;
    uint sum = before + group_exclusive_scan(lane, own, total);
    for (uint k = 0u; k < kRowsPerLane; ++k) {
        row_sums[bank_index(lane * kRowsPerLane + k)] = sum;
        sum += own_sums[k];
    }
    barrier();
    for (uint k = 0u; k < kRowsPerLane; ++k) {
        uint row = k * kScanLanes + lane;
        uint sum = row_sums[bank_index(row)];
        for (uint j = 0u; j < kRowWords; ++j) {
            write_word(row * kRowWords + j, sum);
            sum += own_words[k * kRowWords + j];
        }
    }
    return total;
}

#endif
