// States of the candidates, by place: two words for 32 of them, which are undecided and which of these are
// active. A pair more is behind the last. On a surface the weights of the second corners come next.
#ifndef GEODISK_STATES_GLSL
#define GEODISK_STATES_GLSL

uint undecided_word(uint place) { return place >> 5 << 1; }
uint active_word(uint place) { return undecided_word(place) + 1u; }
uint state_bit(uint place) { return 1u << (place & 31u); }
// As many as there are, of a word.
uint lowest_bits(uint count) { return count < 32u ? (1u << count) - 1u : 0xffffffffu; }
uint words_of_states(uint capacity) { return ((capacity + 31u) / 32u + 1u) * 2u; }

#endif
