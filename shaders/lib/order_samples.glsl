// Accepted samples are put in dart order by ranges of orders, so small that few share one, and within
// these by comparing each with the others. Since the run may not be done, those from the batch at work
// are in order but not final from the first on that is not decided.
#ifndef GEODISK_ORDER_SAMPLES_GLSL
#define GEODISK_ORDER_SAMPLES_GLSL

layout(local_size_x_id = 0) in;

GEODISK_ROWS(kBindAccepted, accepted);
GEODISK_CONTROL;

uint own_index() { return own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// Samples to put in order, from control.ordered on.
uint unordered_count() { return control.accepted - control.ordered; }
uvec4 unordered(uint index) { return row_at(accepted, control.ordered + index); }

// Ranges start one entry behind, as cells do, see bin.comp.
uint bucket_of(uint order) { return min(order >> push.bucket_shift, push.buckets - 1u); }
uint bucket_entries() { return push.buckets + 2u; }

#endif
