// A grid of cells over a box of R^n. The head of a cell in the table is a linear form of its position
// modulo the size of the table: one to one if the table holds the whole grid, else a hash. Cells
// adjacent along the first axis have adjacent heads.
#ifndef GEODISK_GRID_GLSL
#define GEODISK_GRID_GLSL

#include "job.glsl"
#include "dimension.glsl"

GEODISK_ROWS(kBindAxes, axes);

struct Axis {
    uint cells;
    bool is_periodic;
    uint stride;
    float unit;    // a step of a coordinate, in minimum distances
    float width;   // of a cell, in minimum distances
    uint per_step; // cells for each step, in units of 2^-32
};

Axis load_axis(uint axis) {
    uvec4 row = row_at(axes, kAxisRows * axis);
    return Axis(row.x & ~kPeriodicAxis, (row.x & kPeriodicAxis) != 0u, row.y,
                uintBitsToFloat(row.z), uintBitsToFloat(row.w),
                row_at(axes, kAxisRows * axis + 1u).w);
}

// Returns the cell that holds a coordinate, and the position in it in units of 2^-32 of its width.
uint cell_on(Axis axis, uint coordinate, out uint inside) {
    uint cell;
    umulExtended(coordinate, axis.per_step, cell, inside);
    return cell;
}

uint head_in_table(uint head) { return head & (job.cells - 1u); }

#endif
