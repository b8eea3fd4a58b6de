// How the pool is divided. All rows are of four words.
//   a slice per lane:  LaneRec, then
//     windows  kWindowRows each
//     events   a row each
//     table    a row per vertex
//   a list per slot:   conflicts, four to a row: idle ones from the front, active ones from the back
#ifndef GEODISK_SLICE_GLSL
#define GEODISK_SLICE_GLSL

uint lane_row(uint lane) { return lane * push.lane_rows; }
uint windows_row(uint lane) { return lane_row(lane) + kLaneRows; }
uint events_row(uint lane) { return windows_row(lane) + kWindowRows * push.window_capacity; }
uint table_row(uint lane) { return events_row(lane) + push.window_capacity; }
uint list_row(uint slot) {
    return push.lanes * push.lane_rows + slot * (push.list_capacity >> 2);
}

// Where in a list of this capacity the active conflict of this number is.
uint active_entry(uint capacity, uint number) { return capacity - 1u - number; }

#endif
