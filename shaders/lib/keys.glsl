// What the caller tells of faces, behind the fans: words, by key_word.
#ifndef GEODISK_KEYS_GLSL
#define GEODISK_KEYS_GLSL

#include "fans.glsl"
#include "job.glsl"

uint key_word(uint i) { return row_at(fans, job.first_key_row + (i >> 2))[i & 3u]; }

#endif
