// Visits all candidates by number, kDrawBlock per work group, and calls visit(unit, number) for each. An
// invocation has consecutive numbers, mostly of one unit.
#ifndef GEODISK_EACH_DRAWN_GLSL
#define GEODISK_EACH_DRAWN_GLSL

#include "job.glsl"
#include "units.glsl"

layout(local_size_x = kWideLanes) in;

void visit(Unit unit, uint number);

// Returns the numbers of the work group, as first and end: none if the buffers do not hold all.
uvec2 own_numbers() {
    uint count = drawn_count();
    uint begin = own_group() * kDrawBlock;
    uint end = count > job.capacity ? 0u : count;
    return uvec2(begin, min(begin + kDrawBlock, end));
}

void visit_each() {
    uvec2 numbers = own_numbers();
    uint first = numbers.x + gl_LocalInvocationID.x * kDrawPerLane;
    if (first >= numbers.y) {
        return;
    }
    uint last = min(first + kDrawPerLane, numbers.y) - 1u;
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
