// Entries of lists of neighbours: from the hits that `reach` records, in no order, to lists by source.
// Integers and comparisons alone. The result does not depend on the order of atomics: entries that they put
// in some order are sorted afterwards.
#ifndef GEODISK_NEIGHBOUR_GLSL
#define GEODISK_NEIGHBOUR_GLSL

layout(local_size_x_id = 0) in; // kSpecLocalSize

const uint kDropped = 0xffffffffu; // distance of an entry that another one of its number beats

uint own_index() { return own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

#endif
