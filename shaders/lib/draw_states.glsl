// Sets the states of candidates that are drawn. Needs `states`.
#ifndef GEODISK_DRAW_STATES_GLSL
#define GEODISK_DRAW_STATES_GLSL

#include "states.glsl"

// Whose numbers a work group of visit_each() goes through: their places are the same, in another order.
void draw_states() {
    uint count = drawn_count();
    uint begin = own_group() * kDrawBlock;
    if (begin >= count || count > push.capacity) {
        return;
    }
    uint end = min(begin + kDrawBlock, count);
    for (uint first = begin + 32u * gl_LocalInvocationID.x; first < end; first += 32u * kWideLanes) {
        uint left = end - first;
        states[undecided_word(first)] = left < 32u ? (1u << left) - 1u : 0xffffffffu;
        states[active_word(first)] = 0u;
    }
}

#endif
