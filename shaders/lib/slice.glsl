// Division of the pool. All rows are of four words.
//   a slice per lane:  LaneRec, then
//     windows  kWindowRows each
//     events   a row each
//     table    a row per vertex
//     windows kept, kKeptRows each, and what windows remember, four to a row, where disks may trim
//   a list per slot:   conflicts, four to a row: idle ones from the front, active ones from the back
// The slices of kPoolBlock lanes alternate row by row, so that lanes that step together read side by
// side.
#ifndef GEODISK_SLICE_GLSL
#define GEODISK_SLICE_GLSL

layout(constant_id = kSpecPoolBlock) const uint kLanesOfBlock = 1u; // a power of two
layout(constant_id = kSpecLanesApart) const bool kLanesApart = false;
const uint kPoolBlock = kLanesApart ? 1u : kLanesOfBlock;

uint first_row(uint lane) {
    return (lane & ~(kPoolBlock - 1u)) * push.lane_rows + (lane & (kPoolBlock - 1u));
}

#endif
