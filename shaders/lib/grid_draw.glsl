// Draws the pool into a grid and counts the candidates of every head of its table of cells. Needs
// draw_point(rank).
#ifndef GEODISK_GRID_DRAW_GLSL
#define GEODISK_GRID_DRAW_GLSL

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindCells, coherent, uint, cells);
GEODISK_BUFFER(kBindPlaces, writeonly, uint, places);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);

void main() {
    uint rank = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                gl_GlobalInvocationID.x;
    if (rank >= push.candidates) {
        return;
    }
    uint point[kMostAxes] = draw_point(rank);
    uint head = 0u;
    for (uint i = 0u; i < kDimension; ++i) {
        Axis axis = load_axis(i);
        uint inside;
        head += cell_on(axis, point[i], inside) * axis.stride;
    }
    head = head_in_table(head);
    places[rank] = head;
    marks[rank] = atomicAdd(cells[head], 1u);
}

#endif
