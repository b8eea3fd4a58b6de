// Exclusive scan of a block of kScanBlock words by a work group. The words go through shared memory, so
// that neighbours read and write side by side, and each lane sums words that follow each other.
#ifndef GEODISK_BLOCK_SCAN_GLSL
#define GEODISK_BLOCK_SCAN_GLSL

#include "group_scan.glsl"

// A word is skipped behind those of each lane: lanes would all read from one bank.
shared uint block_words[kScanBlock + kScanLanes];

uint block_index(uint i) { return i + i / kScanPerLane; }

// Every lane must call it, once the words are in block_words. Returns the sum of all; `before` is added
// to each.
uint block_exclusive_scan(uint lane, uint before) {
    barrier();
    uint first = block_index(lane * kScanPerLane);
    uint own_words[kScanPerLane];
    uint own = 0u;
    for (uint i = 0u; i < kScanPerLane; ++i) {
        own_words[i] = block_words[first + i];
        own += own_words[i];
    }
    uint total;
    uint sum = before + group_exclusive_scan(lane, own, total);
    for (uint i = 0u; i < kScanPerLane; ++i) {
        block_words[first + i] = sum;
        sum += own_words[i];
    }
    barrier();
    return total;
}

#endif
