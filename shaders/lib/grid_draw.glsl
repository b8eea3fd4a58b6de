// Draws the candidates into a grid, sorted by the heads of its table of cells. Needs draw_point(unit,
// number, record) and words_per_point().
#ifndef GEODISK_GRID_DRAW_GLSL
#define GEODISK_GRID_DRAW_GLSL

#include "job.glsl"
#include "each_drawn.glsl"
#include "grid_head.glsl"
#include "point_words.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);
GEODISK_BUFFER(kBindPoints, writeonly, uint, points);
GEODISK_BUFFER(kBindOrders, writeonly, uint, orders);

#include "draw_states.glsl"

void visit(Unit unit, uint number) {
    uvec4 record;
    uint point[kMaxAxes] = draw_point(unit, number - unit.first, record);
    uint place = atomicAdd(cells[head_of(point) + 1u], 1u);
    orders[place] = record.x;
    for (uint i = 0u; i < words_per_point(); ++i) {
        points[i * job.capacity + place] = point[i];
    }
    points[number_word(place, words_per_point())] = number;
}

void main() {
    draw_states();
    visit_each();
}

#endif
