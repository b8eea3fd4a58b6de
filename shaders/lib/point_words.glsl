// Layout of the points buffer: the coordinates of the candidates, axis after axis, then the numbers they
// were drawn by, then the coordinates of samples of earlier chunks that have slots. For a candidate use
// PointWords(place, job.capacity).
#ifndef GEODISK_POINT_WORDS_GLSL
#define GEODISK_POINT_WORDS_GLSL

#include "job.glsl"

struct PointWords {
    uint first;
    uint stride;
};

PointWords words_of_settled(uint slot, uint words_per_point) {
    return PointWords((words_per_point + 1u) * job.capacity + slot, push.slots);
}

// Returns where the number is that the candidate at this place was drawn by.
uint number_word(uint place, uint words_per_point) {
    return words_per_point * job.capacity + place;
}

#endif
