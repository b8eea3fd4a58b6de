// States of the candidates, by place: two words per 32 candidates, the undecided ones and those of them
// that are active. One more pair follows the last. On a surface the weights of the second corners come
// next.
#ifndef GEODISK_STATES_GLSL
#define GEODISK_STATES_GLSL

uint undecided_word(uint place) { return place >> 5 << 1; }
uint active_word(uint place) { return undecided_word(place) + 1u; }
uint state_bit(uint place) { return 1u << (place & 31u); }
// Returns a word with this many lowest bits set, at most all.
uint lowest_bits(uint count) { return count < 32u ? (1u << count) - 1u : 0xffffffffu; }
uint words_of_states(uint capacity) { return ((capacity + 31u) / 32u + 1u) * 2u; }

#endif
