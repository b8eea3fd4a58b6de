// Sets the states of drawn candidates. Needs `orders` and each_drawn.glsl.
#ifndef GEODISK_DRAW_STATES_GLSL
#define GEODISK_DRAW_STATES_GLSL

#include "states.glsl"

// Sets the states at the numbers of the work group. All places together are all numbers in another
// order.
void draw_states() {
    uvec2 numbers = own_numbers();
    for (uint first = numbers.x + 32u * gl_LocalInvocationID.x; first < numbers.y;
         first += 32u * kWideLanes) {
        orders[undecided_word(first)] = lowest_bits(numbers.y - first);
        orders[active_word(first)] = 0u;
    }
}

#endif
