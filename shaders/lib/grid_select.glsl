// Selects the next batch for disks found by a grid in space. The points of samples of earlier chunks,
// which have no place, go after those of the candidates. Needs draw_point(unit, number, record),
// point_of(record) and words_per_point().
#ifndef GEODISK_GRID_SELECT_GLSL
#define GEODISK_GRID_SELECT_GLSL

#include "point_words.glsl"
#include "units.glsl"

GEODISK_BUFFER(kBindPoints, , uint, points);

uvec4 sample_at(uint place, uint order) {
    uint number = points[number_word(place, words_per_point())];
    Unit unit = find_unit(number);
    uvec4 record;
    draw_point(unit, number - unit.first, record);
    return record;
}

void settle_point(uint slot, uvec4 record) {
    uint point[kMaxAxes] = point_of(record);
    PointWords words = words_of_settled(slot, words_per_point());
    for (uint i = 0u; i < words_per_point(); ++i) {
        points[words.first + i * words.stride] = point[i];
    }
}

#include "select_idle.glsl"

#endif
