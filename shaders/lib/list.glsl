// The list of conflicts of the slot at work, idle ones from the front, active ones from the back.
#ifndef GEODISK_LIST_GLSL
#define GEODISK_LIST_GLSL

uint idle_conflicts; // listed so far
uint active_conflicts;
uint list_first;     // row of this slot's list
uint overflow;       // kOverflow* bits

void list_conflict(uint place, bool is_active) {
    if (idle_conflicts + active_conflicts >= P.list_capacity) {
        overflow |= kOverflowConflicts;
        return;
    }
    uint at = is_active ? active_entry(P.list_capacity, active_conflicts) : idle_conflicts;
    pool[list_first + (at >> 2)][at & 3u] = place;
    active_conflicts += is_active ? 1u : 0u;
    idle_conflicts += is_active ? 0u : 1u;
}

#endif
