// How a slot's slice of the pool is divided. All rows are of four words.
//   heap     two entries a row; entry i lies at half-row i + 3, so that the four children of an
//            entry share two rows
//   windows  kWindowRows each
//   table    a row per vertex
//   list     conflicts, four to a row
#ifndef GEODISK_SLICE_GLSL
#define GEODISK_SLICE_GLSL

uint slice_row(uint slot) { return slot * push.slice_rows; }
uint windows_row(uint slot) { return slice_row(slot) + push.window_capacity / 2u + 2u; }
uint table_row(uint slot) { return windows_row(slot) + kWindowRows * push.window_capacity; }
uint list_row(uint slot) { return table_row(slot) + push.table_capacity; }

#endif
