// Read-only access to the lists of conflicts, once all disks of a batch are complete.
#ifndef GEODISK_CONFLICTS_GLSL
#define GEODISK_CONFLICTS_GLSL

#include "lists.glsl"

// Returns the row of a slot's list that holds this entry.
uvec4 list_row_at(uint slot, uint at) { return row_at(pool, list_row(slot) + (at >> 2)); }

uint active_conflict(uint slot, uint number) {
    uint at = active_entry(push.list_capacity, number);
    return list_row_at(slot, at)[at & 3u];
}

#endif
