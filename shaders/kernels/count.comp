#version 450
#extension GL_GOOGLE_include_directive : require
// Counts the candidates of each face.
// reads: faces, fans (keys, mask, radii)   writes: starts (counts), cells (counts of faces of one cell)
// spec: local size, rounding, adaptive, many rows

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"
#include "../lib/many_rows.glsl"

GEODISK_BUFFER(kBindCells, coherent, uint, cells);

float mean_count(uint face) {
    uvec4 lengths = load_lengths(face);
    Edge edge = load_edge(face, 0u, lengths);
    precise float area = 0.5 * (edge.len * apex_of(edge, load_edge(face, 2u, lengths)).y);
    return takes_samples(face) ? mean_in(face, area) : 0.0;
}

void counted(uint face, uint number) {
    if (kManyRows) {
        uint word = load_cells(face);
        if (single_cell(word)) {
            atomicAdd(cells[(word & kFirstCellMask) + 1u], number);
        }
    }
}

#include "../lib/count_units.glsl"
