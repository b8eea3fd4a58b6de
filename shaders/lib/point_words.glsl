// Where the words of a point are in the buffer of points: those of the candidates first, one
// coordinate after the other, then likewise those of the samples of earlier chunks that have slots.
// Of a candidate they are PointWords(place, push.candidates).
#ifndef GEODISK_POINT_WORDS_GLSL
#define GEODISK_POINT_WORDS_GLSL

struct PointWords {
    uint first;
    uint stride;
};

PointWords words_of_settled(uint slot, uint words_per_point) {
    return PointWords(words_per_point * push.candidates + slot, push.slots);
}

#endif
