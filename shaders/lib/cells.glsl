// Grid of cells over a face, in the frame of its longest edge.
#ifndef GEODISK_CELLS_GLSL
#define GEODISK_CELLS_GLSL

struct Grid {
    uint first;   // first cell, row by row
    uint columns;
    uint rows;
    float per_unit; // cells per unit of length
};

bool single_cell(uint word) { return (word >> kFaceCornerShift) == kSingleCell; }
// Returns the corner where the longest edge starts, for a face with several cells.
uint grid_corner(uint word) { return word >> kFaceCornerShift; }

uint cell_count(float extent, float per_unit) {
    precise float scaled = extent * per_unit;
    return uint(scaled) + 1u;
}

uint cell_at(float x, uint count, float per_unit) {
    precise float scaled = x * per_unit;
    return uint(clamp(scaled, 0.0, float(count - 1u)));
}

// Returns the grid; `len` and `height` are those of the face over its longest edge.
Grid face_grid(uint word, float len, float height, float per_unit) {
    bool single = single_cell(word);
    return Grid(word & kFirstCellMask, single ? 1u : cell_count(len, per_unit),
                single ? 1u : cell_count(height, per_unit), per_unit);
}

#endif
