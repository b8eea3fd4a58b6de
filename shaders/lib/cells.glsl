// The grid of cells over a face, in the frame of its longest edge.
#ifndef GEODISK_CELLS_GLSL
#define GEODISK_CELLS_GLSL

struct Grid {
    uint first;   // first cell, row by row
    uint columns;
    uint rows;
};

bool single_cell(uint word) { return (word >> kFaceCornerShift) == kSingleCell; }
// Of a face with more than one cell: the corner its longest edge starts from.
uint grid_corner(uint word) { return word >> kFaceCornerShift; }

uint cell_count(float extent) { return uint(extent * float(kCellsPerDistance)) + 1u; }

uint cell_at(float x, uint count) {
    precise float scaled = x * float(kCellsPerDistance);
    if (scaled <= 0.0) {
        return 0u;
    }
    return scaled >= float(count - 1u) ? count - 1u : uint(scaled);
}

// `len` and `height` are those of the face over its longest edge.
Grid face_grid(uint word, float len, float height) {
    bool single = single_cell(word);
    return Grid(word & kFirstCellMask, single ? 1u : cell_count(len),
                single ? 1u : cell_count(height));
}

#endif
