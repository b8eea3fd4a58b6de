// How a slot's slice of the pool is divided. All rows are of four words.
//   windows  kWindowRows each
//   events   a row each
//   table    a row per vertex
//   list     conflicts, four to a row: idle ones from the front, active ones from the back
#ifndef GEODISK_SLICE_GLSL
#define GEODISK_SLICE_GLSL

uint slice_row(uint slot) { return slot * push.slice_rows; }
uint events_row(uint slot) { return slice_row(slot) + kWindowRows * push.window_capacity; }
uint table_row(uint slot) { return events_row(slot) + push.window_capacity; }
uint list_row(uint slot) { return table_row(slot) + push.table_capacity; }

// Where in the list the active conflict of this number is.
uint active_entry(uint number) { return push.list_capacity - 1u - number; }

#endif
