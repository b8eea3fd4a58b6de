// Several surfaces: the surface of a face, and the data of each surface.
#ifndef GEODISK_PARTS_GLSL
#define GEODISK_PARTS_GLSL

#include "job.glsl"
#include "keys.glsl"

layout(constant_id = kSpecSeveral) const bool kSeveral = false;

uint part_of(uint face) { return key_word(job.faces + face); }

// Returns a word of PartRec.
uint part_word(uint part, uint word) {
    return key_word(2u * job.faces + kPartWords * part + word);
}

#endif
