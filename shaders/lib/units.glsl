// The units of a face or cell are consecutive, one per stage. Candidates are numbered unit by unit;
// without larger faces to sort, they are in memory in this order.
#ifndef GEODISK_UNITS_GLSL
#define GEODISK_UNITS_GLSL

#include "job.glsl"
#include "quotient.glsl"
#include "unit.glsl"

GEODISK_WORDS(kBindStarts, starts);

uint unit_count() { return job.faces * push.stages; }
uint drawn_count() { return word_at(starts, unit_count()); }

// Returns the unit of the candidate with this number, from `low` up to, not including, `high`.
uint unit_of(uint number, uint low, uint high) {
    while (low + 1u < high) {
        uint middle = (low + high) >> 1;
        bool is_after = word_at(starts, middle) <= number;
        low = is_after ? middle : low;
        high = is_after ? high : middle;
    }
    return low;
}

// Returns the unit of a candidate in a unit after `before`, which is mostly near: searched in doubling
// steps.
uint unit_after(uint number, uint before) {
    uint low = before + 1u;
    uint step = 1u;
    while (low + step < unit_count() && word_at(starts, low + step) <= number) {
        low += step;
        step += step;
    }
    return unit_of(number, low, min(low + step, unit_count()));
}

Unit load_unit(uint unit) {
    uint owner = quotient(unit, push.stages, inverse_of(push.stages));
    return Unit(owner, unit - owner * push.stages, word_at(starts, unit));
}

// Returns the unit of the candidate with this number.
Unit find_unit(uint number) { return load_unit(unit_of(number, 0u, unit_count())); }

#endif
