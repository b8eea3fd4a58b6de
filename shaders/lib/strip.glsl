// A strip: up to 32 candidates adjacent in memory, as bits. Needs `orders`.
#ifndef GEODISK_STRIP_GLSL
#define GEODISK_STRIP_GLSL

#include "states.glsl"

struct Strip {
    uint first;
    uint undecided;
    uint actives;
};

// Loads candidates from `first` up to, not including, `end`, as many as fit. They may lie across two
// words.
Strip load_strip(uint first, uint end) {
    // The first of an empty row may be after the last candidate of all.
    uint from = first < end ? first : 0u;
    uint word = undecided_word(from);
    uint skipped = from & 31u;
    uint undecided = word_at(orders, word) >> skipped;
    uint actives = word_at(orders, word + 1u) >> skipped;
    // In two steps, since shifts by 32 are undefined.
    uint rest = word_at(orders, word + 2u) << (31u - skipped);
    uint actives_rest = word_at(orders, word + 3u) << (31u - skipped);
    uint within = lowest_bits(first < end ? end - first : 0u);
    return Strip(first, (undecided | rest << 1) & within, actives | actives_rest << 1);
}

bool is_active(Strip strip, uint bit) { return ((strip.actives >> bit) & 1u) != 0u; }

#endif
