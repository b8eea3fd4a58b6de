// Sum of a value over the lanes before this one, in a work group of kScanLanes.
#ifndef GEODISK_GROUP_SCAN_GLSL
#define GEODISK_GROUP_SCAN_GLSL

shared uint group_sums[2u * kScanLanes];

// Every lane must call it. `total` is the sum over all lanes.
uint group_exclusive_scan(uint lane, uint value, out uint total) {
    // The lower half stays zero, so that no lane needs to look whether one before it exists.
    barrier();
    group_sums[lane] = 0u;
    group_sums[kScanLanes + lane] = value;
    barrier();
    for (uint offset = 1u; offset < kScanLanes; offset <<= 1) {
        uint sum = group_sums[kScanLanes + lane] + group_sums[kScanLanes + lane - offset];
        barrier();
        group_sums[kScanLanes + lane] = sum;
        barrier();
    }
    total = group_sums[2u * kScanLanes - 1u];
    return group_sums[kScanLanes + lane] - value;
}

#endif
