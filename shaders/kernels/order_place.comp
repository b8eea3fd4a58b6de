#version 450
#extension GL_GOOGLE_include_directive : require
// Sorts the samples by ranges of orders. One invocation per sample.
// reads: accepted, control   writes: buckets   spec: local size

#include "../lib/prelude.glsl"
#include "../lib/order_samples.glsl"

GEODISK_BUFFER(kBindBuckets, coherent, uint, buckets);

void main() {
    uint index = own_index();
    if (index < unordered_count()) {
        uint at = atomicAdd(buckets[bucket_of(unordered(index).x) + 1u], 1u);
        buckets[bucket_entries() + at] = index;
    }
}
