#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates in each cell of the faces that have more than one. An entry of the table is
// behind that of its cell, so that after the scan and after `draw` has moved each on, a cell's
// candidates start at its own entry.
// reads: faces, keys, radii, starts   writes: cells   spec: rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/face_cell.glsl"
#include "../lib/each_drawn.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);

void visit(Unit unit, uint number) {
    uint word = load_cells(unit.owner);
    if (!single_cell(word)) {
        Candidate c = draw_candidate(unit.owner, unit.stage, number - unit.first);
        atomicAdd(cells[cell_of(c, word) + 1u], 1u);
    }
}

void main() { visit_each(); }
