// Conflict list of the slot in work, idle ones from the front, active ones from the back. Sets
// `overflow` if the list is full.
#ifndef GEODISK_LIST_GLSL
#define GEODISK_LIST_GLSL

#include "lists.glsl"

// Lists a conflict; the counts are those so far. The place of a candidate that is not listed is written
// too, where the next one goes: on lavapipe a store is a branch per lane, which should not depend on
// chance.
void list_conflict(inout uint idle_count, inout uint active_count, uint place, bool is_active,
                   bool is_listed) {
    if (idle_count + active_count >= push.list_capacity) {
        overflow |= is_listed ? kOverflowConflicts : 0u;
        return;
    }
    uint at = is_active ? active_entry(push.list_capacity, active_count) : idle_count;
    pool[list_first + (at >> 2)][at & 3u] = place;
    active_count += is_listed && is_active ? 1u : 0u;
    idle_count += is_listed && !is_active ? 1u : 0u;
}

#endif
