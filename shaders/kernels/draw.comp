#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates, those of larger faces sorted by cell, and begins the chunk.
// reads: faces, keys, radii, starts   writes: states, weights, orders, cells, control
// spec: rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/face_cell.glsl"
#include "../lib/each_drawn.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);
GEODISK_BUFFER(kBindStates, writeonly, uint, states);
GEODISK_BUFFER(kBindWeights, writeonly, uint, weights);
GEODISK_BUFFER(kBindOrders, writeonly, uint, orders);

void visit(uint unit, uint number) {
    uint face = unit / push.stages;
    Candidate c = draw_candidate(face, unit - face * push.stages, number - word_at(starts, unit));
    uint word = load_cells(face);
    uint place = number;
    if (!single_cell(word)) {
        place = atomicAdd(cells[cell_of(c, word) + 1u], 1u);
    } else if (push.all_single == 0u &&
               number + 1u == word_at(starts, (face + 1u) * push.stages)) {
        cells[(word & kFirstCellMask) + 1u] = number + 1u;
    }
    states[place] = c.weight1 << kWeightShift | kIdle;
    weights[place] = c.weight2;
    orders[place] = c.order;
}

void main() { visit_each(); }
