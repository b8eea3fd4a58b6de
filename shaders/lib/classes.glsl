// Classes of candidates (Wei 2010): the distance of two depends on their classes. Kernels for candidates
// of one kind contain none of this.
#ifndef GEODISK_CLASSES_GLSL
#define GEODISK_CLASSES_GLSL

#include "class_bits.glsl"
#include "fans.glsl"
#include "job.glsl"

uint class_word(uint i) { return row_at(fans, job.first_class_row + (i >> 2))[i & 3u]; }
float class_number(uint i) { return uintBitsToFloat(class_word(i)); }

// Returns the distance below which candidates of two classes conflict.
float class_distance(uint a, uint b) {
    return class_number(kClassDistances + kMaxClasses * a + b);
}

// Returns the largest distance of a class.
float class_reach(uint a) { return class_number(kClassReaches + a); }

// Returns the class that a random word stands for.
uint class_of_random(uint random) {
    uvec4 low = uvec4(greaterThan(uvec4(random), row_at(fans, job.first_class_row)));
    uvec3 high = uvec3(greaterThan(uvec3(random), row_at(fans, job.first_class_row + 1u).xyz));
    return low.x + low.y + low.z + low.w + high.x + high.y + high.z;
}

// Returns true if classes have shares.
bool has_shares() { return class_word(kClassShares) != 0u; }

// Returns the shares of a class at the corners of a face.
vec3 class_shares(uint face, uint number) {
    uint word = class_word(kClassWords + face * class_word(kClassShares) + number);
    uint most = (1u << kShareBits) - 1u;
    vec3 steps = vec3(word & most, word >> kShareBits & most, word >> (2u * kShareBits));
    precise vec3 shares = steps * (1.0 / float(kWholeShare));
    return shares;
}

// Returns the order of a candidate with its class in the lowest bits. Priorities of a class with a large
// distance are smaller, so that the few candidates that it has are as dense among the first of a stage as
// those of other classes.
uint with_class(uint order, uint number) {
    uint priority = order & ((1u << kPriorityBits) - 1u);
    uint high, low;
    umulExtended(priority << 1, class_word(kClassTurns + number), high, low);
    return (order - priority) | (high & ~kClassMask) | number;
}

#endif
