// What candidates are drawn by: a face or a cell of a box, in one stage, is a unit. The units of a face
// follow each other, stage by stage. Candidates are numbered unit by unit, and without larger faces
// to sort they lie in memory that way.
#ifndef GEODISK_UNITS_GLSL
#define GEODISK_UNITS_GLSL

GEODISK_WORDS(kBindStarts, starts);

uint unit_count() { return push.faces * push.stages; }
uint drawn_count() { return word_at(starts, unit_count()); }

// The unit of the candidate with this number, from `low` on and before `high`.
uint unit_of(uint number, uint low, uint high) {
    while (low + 1u < high) {
        uint middle = (low + high) >> 1;
        bool is_after = word_at(starts, middle) <= number;
        low = is_after ? middle : low;
        high = is_after ? high : middle;
    }
    return low;
}

// The face of the candidate with this number.
uint face_of(uint number) { return unit_of(number, 0u, unit_count()) / push.stages; }

#endif
