// Cell of a candidate on a face.
#ifndef GEODISK_FACE_CELL_GLSL
#define GEODISK_FACE_CELL_GLSL

#include "candidate.glsl"
#include "half_edge.glsl"
#include "cells.glsl"

// Returns the cell of a candidate; `word` is the cell word of a face with several cells.
uint cell_of(Candidate c, uint word) {
    uint corner = grid_corner(word);
    uvec4 lengths = load_lengths(c.face);
    Edge edge = load_edge(c.face, corner, lengths);
    vec2 apex = apex_of(edge, load_edge(c.face, previous_corner(corner), lengths));
    vec4 radii = kAdaptive ? face_radii(c.face) : vec4(0.5);
    Grid grid = face_grid(word, edge.len, apex.y, cells_per_unit(radii));
    vec2 at = position_in(corner, edge.len, apex, weight_of(c.weight1), weight_of(c.weight2));
    return grid.first + cell_at(at.y, grid.rows, grid.per_unit) * grid.columns +
           cell_at(at.x, grid.columns, grid.per_unit);
}

#endif
