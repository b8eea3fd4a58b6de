// Unit: a face or a cell of a box, in one stage. Candidates are drawn by units.
#ifndef GEODISK_UNIT_GLSL
#define GEODISK_UNIT_GLSL

struct Unit {
    uint owner; // face or cell
    uint stage; // of the chunk
    uint first; // number of its first candidate
};

#endif
