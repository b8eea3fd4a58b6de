#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates in each cell, for faces with several cells. The count of a cell goes to the
// entry after its own. After the scan, and after `draw` has advanced each entry, the candidates of a
// cell start at its own entry.
// reads: faces, fans (keys, radii), starts   writes: cells   spec: rounding, adaptive

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
