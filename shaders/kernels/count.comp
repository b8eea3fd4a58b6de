#version 450
#extension GL_GOOGLE_include_directive : require
// How many candidates each face has in each stage, by the Poisson law (paper GenerateDensePoints,
// sections 3.3 and 4.2). One invocation per face and stage.
// reads: faces, keys, radii   writes: starts (counts), cells (counts of faces of one cell)
// spec: local size, rounding, adaptive

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStarts, writeonly, uint, starts);
GEODISK_BUFFER(kBindCells, coherent, uint, cells);

void main() {
    uint unit = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (unit >= push.faces * push.stages) {
        return;
    }
    uint face = unit / push.stages;
    Edge edge = load_edge(face, 0u);
    precise float area = 0.5 * (edge.len * apex_of(edge, load_edge(face, 2u)).y);
    uint count = count_candidates(face, unit - face * push.stages, area);
    starts[unit] = count;
    uint word = load_links(face).w;
    if (push.all_single == 0u && single_cell(word)) {
        atomicAdd(cells[(word & kFirstCellMask) + 1u], count);
    }
}
