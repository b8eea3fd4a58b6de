// The grid of cells over a face, in the frame of its longest edge.
#ifndef GEODISK_CELLS_GLSL
#define GEODISK_CELLS_GLSL

struct Grid {
    uint base;    // half-edge whose frame the grid lies in
    uint first;   // first cell, row by row
    uint columns;
    uint rows;
};

uint cell_count(float extent) { return uint(extent * float(kCellsPerDistance)) + 1u; }

uint cell_at(float x, uint count) {
    precise float scaled = x * float(kCellsPerDistance);
    if (scaled <= 0.0) {
        return 0u;
    }
    return scaled >= float(count - 1u) ? count - 1u : uint(scaled);
}

// The grid of a face whose word says that it has more than one cell; `edge` is that of `base`.
Grid face_grid(uint face, uint word, out Edge edge) {
    uint base = 3u * face + (word >> kFaceCornerShift);
    edge = load_edge(base);
    return Grid(base, word & kFirstCellMask, cell_count(edge.len), cell_count(edge.apex_y));
}

bool single_cell(uint word) { return (word >> kFaceCornerShift) == kSingleCell; }

#endif
