// Several surfaces: the surface of a face, and the data of each surface.
#ifndef GEODISK_PARTS_GLSL
#define GEODISK_PARTS_GLSL

layout(constant_id = kSpecSeveral) const bool kSeveral = false;

GEODISK_WORDS(kBindKeys, keys);

uint part_of(uint face) { return word_at(keys, push.faces + face); }

// Returns a word of PartRec.
uint part_word(uint part, uint word) {
    return word_at(keys, 2u * push.faces + kPartWords * part + word);
}

#endif
