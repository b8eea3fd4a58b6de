// Where the words of a point are in the buffer of points: those of the candidates first, one
// coordinate after the other, and behind them the numbers they were drawn by; then the coordinates of
// samples of earlier chunks that have slots. Of a candidate they are PointWords(place, push.capacity).
#ifndef GEODISK_POINT_WORDS_GLSL
#define GEODISK_POINT_WORDS_GLSL

struct PointWords {
    uint first;
    uint stride;
};

PointWords words_of_settled(uint slot, uint words_per_point) {
    return PointWords((words_per_point + 1u) * push.capacity + slot, push.slots);
}

// Where the number is that the candidate at this place was drawn by.
uint number_word(uint place, uint words_per_point) {
    return words_per_point * push.capacity + place;
}

#endif
