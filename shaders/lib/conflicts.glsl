// Read-only access to the lists of conflicts, once all disks of a batch are complete.
#ifndef GEODISK_CONFLICTS_GLSL
#define GEODISK_CONFLICTS_GLSL

// Four entries of a slot's list, from a multiple of four on.
uvec4 four_conflicts(uint slot, uint at) { return row_at(pool, list_row(slot) + (at >> 2)); }

uint active_conflict(uint slot, uint number) {
    uint at = active_entry(push.list_capacity, number);
    return four_conflicts(slot, at)[at & 3u];
}

#endif
