// Head in a grid's cell table of the cell that holds a point.
#ifndef GEODISK_GRID_HEAD_GLSL
#define GEODISK_GRID_HEAD_GLSL

uint head_of(uint point[kMaxAxes]) {
    uint head = 0u;
    for (uint i = 0u; i < kDimension; ++i) {
        Axis axis = load_axis(i);
        uint inside;
        head += cell_on(axis, point[i], inside) * axis.stride;
    }
    return head_in_table(head);
}

#endif
