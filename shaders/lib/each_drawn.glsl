// Goes through all candidates by their numbers, kDrawBlock of them to a work group, and calls
// visit(unit, number) for each.
#ifndef GEODISK_EACH_DRAWN_GLSL
#define GEODISK_EACH_DRAWN_GLSL

#include "units.glsl"

layout(local_size_x = kWideLanes) in;

void visit(uint unit, uint number);

void visit_each() {
    uint count = drawn_count();
    uint begin = own_group() * kDrawBlock;
    if (begin >= count || count > push.capacity) {
        return;
    }
    uint end = min(begin + kDrawBlock, count);
    // Few units make up a group.
    uint low = unit_of(begin, 0u, unit_count());
    uint high = unit_of(end - 1u, low, unit_count()) + 1u;
    for (uint number = begin + gl_LocalInvocationID.x; number < end; number += kWideLanes) {
        visit(unit_of(number, low, high), number);
    }
}

#endif
