// Lists of conflicts in the pool, behind the slices.
#ifndef GEODISK_LISTS_GLSL
#define GEODISK_LISTS_GLSL

uint list_first; // first row of the list of the slot in work

uint list_row(uint slot) { return push.first_list_row + slot * (push.list_capacity >> 2); }

// Returns where this active conflict is in a list of this capacity.
uint active_entry(uint capacity, uint number) { return capacity - 1u - number; }

#endif
