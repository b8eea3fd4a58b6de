#version 450
#extension GL_GOOGLE_include_directive : require
// Draws the pool and counts the candidates of every cell (paper GenerateDensePoints, sections 3.3
// and 4.2). One invocation per candidate.
// reads: alias columns, faces, radii   writes: cell counts; the cell of each candidate into places, and its
// number there into marks   spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindCells, coherent, uint, cells);
GEODISK_BUFFER(kBindPlaces, writeonly, uint, places);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);

uint cell_of(Candidate c) {
    uint word = load_links(c.face).w;
    if (single_cell(word)) {
        return word & kFirstCellMask;
    }
    uint corner = grid_corner(word);
    Edge edge = load_edge(c.face, corner);
    vec2 apex = apex_of(edge, load_edge(c.face, previous_corner(corner)));
    vec4 radii = kAdaptive ? face_radii(c.face) : vec4(0.5);
    Grid grid = face_grid(word, edge.len, apex.y, cells_per_unit(radii));
    vec2 at = position_in(corner, edge.len, apex, weight_of(c.weight1), weight_of(c.weight2));
    return grid.first + cell_at(at.y, grid.rows, grid.per_unit) * grid.columns +
           cell_at(at.x, grid.columns, grid.per_unit);
}

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    uint cell = cell_of(draw_candidate(rank));
    places[rank] = cell;
    marks[rank] = atomicAdd(cells[cell], 1u);
}
