// Input of the caller about faces, behind the fans: words, by key_word, and which faces take
// samples.
#ifndef GEODISK_KEYS_GLSL
#define GEODISK_KEYS_GLSL

#include "fans.glsl"
#include "job.glsl"

uint key_word(uint i) { return row_at(fans, job.first_key_row + (i >> 2))[i & 3u]; }

bool takes_samples(uint face) {
    if (job.first_mask_row == 0u) {
        return true;
    }
    uint word = row_at(fans, job.first_mask_row + (face >> 7))[(face >> 5) & 3u];
    return (word >> (face & 31u) & 1u) != 0u;
}

#endif
