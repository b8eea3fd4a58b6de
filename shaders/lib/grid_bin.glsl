// Counts the candidates of every head of a grid's cell table, one entry after that of the head, see
// bin.comp. Needs draw_point(unit, number, record).
#ifndef GEODISK_GRID_BIN_GLSL
#define GEODISK_GRID_BIN_GLSL

#include "each_drawn.glsl"
#include "grid_head.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);

void visit(Unit unit, uint number) {
    uvec4 record;
    uint point[kMaxAxes] = draw_point(unit, number - unit.first, record);
    atomicAdd(cells[head_of(point) + 1u], 1u);
}

void main() { visit_each(); }

#endif
