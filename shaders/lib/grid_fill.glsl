// Draws the candidates again in the order of the cells of a grid, see bin_fill. Needs
// draw_point(rank) and words_per_point().
#ifndef GEODISK_GRID_FILL_GLSL
#define GEODISK_GRID_FILL_GLSL

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, writeonly, uint, states);
GEODISK_BUFFER(kBindPoints, , uint, points);

void main() {
    uint place = gl_WorkGroupID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) +
                 gl_GlobalInvocationID.x;
    if (place >= push.candidates) {
        return;
    }
    uint point[kMostAxes] = draw_point(points[place]);
    states[place] = kIdle;
    for (uint i = 0u; i < words_per_point(); ++i) {
        points[i * push.candidates + place] = point[i];
    }
}

#endif
