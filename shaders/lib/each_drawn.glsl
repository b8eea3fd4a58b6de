// Goes through all candidates by their numbers, kDrawBlock of them to a work group, and calls
// visit(unit, number) for each. An invocation has numbers that follow each other, mostly of one unit.
#ifndef GEODISK_EACH_DRAWN_GLSL
#define GEODISK_EACH_DRAWN_GLSL

#include "units.glsl"

layout(local_size_x = kWideLanes) in;

void visit(Unit unit, uint number);

void visit_each() {
    uint count = drawn_count();
    uint first = own_group() * kDrawBlock + gl_LocalInvocationID.x * kDrawPerLane;
    if (first >= count || count > push.capacity) {
        return;
    }
    uint last = min(first + kDrawPerLane, count) - 1u;
    uint at = unit_of(first, 0u, unit_count());
    uint end = word_at(starts, at + 1u);
    for (uint number = first; number <= last; ++number) {
        if (number >= end) {
            at = unit_after(number, at);
            end = word_at(starts, at + 1u);
        }
        visit(load_unit(at), number);
    }
}

#endif
