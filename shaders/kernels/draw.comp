#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the candidates, sorted by cell in larger faces, and begins the chunk.
// reads: faces, fans (keys, radii), starts   writes: weights, orders, cells, control
// spec: rounding, adaptive, many rows, keyed, classes

#include "../lib/prelude.glsl"
#include "../lib/face_cell.glsl"
#include "../lib/many_rows.glsl"
#include "../lib/each_drawn.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);
GEODISK_BUFFER(kBindWeights, writeonly, uint, weights);
GEODISK_BUFFER(kBindOrders, writeonly, uint, orders);

#include "../lib/draw_states.glsl"

void visit(Unit unit, uint number) {
    Candidate c = draw_candidate(unit.owner, unit.stage, number - unit.first);
    uint place = number;
    if (kManyRows) {
        uint word = load_cells(unit.owner);
        if (!single_cell(word)) {
            place = atomicAdd(cells[cell_of(c, word) + 1u], 1u);
        } else if (number + 1u == word_at(starts, (unit.owner + 1u) * push.stages)) {
            cells[(word & kFirstCellMask) + 1u] = number + 1u;
        }
    }
    uint dropped = is_dropped(c, unit.stage, number - unit.first) ? kNoDart : 0u;
    weights[2u * place] = weight_with_class(c.weight1, c.order) | dropped;
    weights[2u * place + 1u] = c.weight2;
    orders[place] = c.order;
}

void main() {
    draw_states();
    visit_each();
}
