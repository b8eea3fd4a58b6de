#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the samples in each range of orders, and finds the first undecided candidate. One invocation
// per sample or slot.
// reads: accepted   writes: buckets, control   spec: local size

#include "../lib/prelude.glsl"
#include "../lib/order_samples.glsl"
#include "../lib/slots.glsl"

GEODISK_BUFFER(kBindBuckets, coherent, uint, buckets);

void main() {
    uint index = own_index();
    if (index < control.slots_used && slots[index].place != kNoPlace &&
        slots[index].phase < kSlotDecided) {
        atomicMin(control.first_open, slots[index].order);
    }
    if (index < unordered_count()) {
        atomicAdd(buckets[bucket_of(unordered(index).x) + 1u], 1u);
    }
}
