// Sorts accepted samples in dart order: by ranges of orders so small that few samples share one, and
// within a range by comparing each with the others. The run may continue, so samples from the batch in
// work on are in order, but final only up to its first undecided candidate.
#ifndef GEODISK_ORDER_SAMPLES_GLSL
#define GEODISK_ORDER_SAMPLES_GLSL

#include "job.glsl"

layout(local_size_x_id = 0) in; // kSpecLocalSize

GEODISK_ROWS(kBindAccepted, accepted);
GEODISK_CONTROL;

uint own_index() { return own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// Returns the number of samples to sort, from control.ordered on.
uint unordered_count() { return control.accepted - control.ordered; }
uvec4 unordered(uint index) { return row_at(accepted, control.ordered + index); }

// Returns the range of an order. Ranges start one entry later, like cells, see bin.comp.
uint bucket_of(uint order) { return min(order >> push.bucket_shift, job.buckets - 1u); }
uint bucket_entries() { return job.buckets + 2u; }

#endif
