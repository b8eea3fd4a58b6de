// Exclusive sum of a value over the lanes of a work group of kScanLanes.
#ifndef GEODISK_GROUP_SCAN_GLSL
#define GEODISK_GROUP_SCAN_GLSL

shared uint group_sums[kScanLanes];

// Returns the sum over the lanes before this one. Every lane must call it. `total` is the sum over all
// lanes. Few steps with several terms each: a barrier costs more than a term.
uint group_exclusive_scan(uint lane, uint value, out uint total) {
    uint sum = value;
    for (uint offset = 1u; offset < kScanLanes; offset *= kScanTerms) {
        barrier();
        group_sums[lane] = sum;
        barrier();
        for (uint k = 1u; k < kScanTerms; ++k) {
            uint behind = k * offset;
            sum += behind <= lane ? group_sums[lane - behind] : 0u;
        }
    }
    barrier();
    group_sums[lane] = sum;
    barrier();
    total = group_sums[kScanLanes - 1u];
    return sum - value;
}

#endif
