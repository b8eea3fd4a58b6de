#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the samples in dart order, and the number of final ones. One invocation per sample.
// reads: accepted, buckets   writes: samples, control   spec: local size

#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/order_samples.glsl"
#include "../lib/dart_order.glsl"

GEODISK_WORDS(kBindBuckets, buckets);
GEODISK_BUFFER(kBindSamples, writeonly, uvec4, samples);

shared uint group_ready;

// Returns the position of a sample among all samples.
uint rank_of(uint index, uvec4 own) {
    uint bucket = bucket_of(own.x);
    uint rank = word_at(buckets, bucket);
    uint end = word_at(buckets, bucket + 1u);
    for (uint at = rank; at < end; ++at) {
        rank += is_before(unordered(word_at(buckets, bucket_entries() + at)), own) ? 1u : 0u;
    }
    return control.ordered + rank;
}

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        group_ready = control.ordered;
    }
    barrier();
    uint index = own_index();
    if (index < unordered_count()) {
        // Read by range, so that neighbours compare with the same others.
        uvec4 own = unordered(word_at(buckets, bucket_entries() + index));
        uint rank = rank_of(index, own);
        samples[rank] = own;
        if (own.x < control.first_open) {
            atomicMax(group_ready, rank + 1u);
        }
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        atomicMax(control.ready, min(group_ready, job.stop_count));
    }
}
