// States of the candidates, by place, behind their orders: two words per 32 candidates, the undecided ones
// and those of them that are active. One more pair follows the last.
#ifndef GEODISK_STATES_GLSL
#define GEODISK_STATES_GLSL

#include "job.glsl"

uint undecided_word(uint place) { return job.capacity + (place >> 5 << 1); }
uint active_word(uint place) { return undecided_word(place) + 1u; }
uint state_bit(uint place) { return 1u << (place & 31u); }
// Returns a word with this many lowest bits set, at most all.
uint lowest_bits(uint count) { return count < 32u ? (1u << count) - 1u : 0xffffffffu; }

#endif
