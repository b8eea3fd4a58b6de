// What waits in one invocation to be spread, bounded: windows on a stack, and the events of vertices.
// Windows go first, the nearer child of two before the other; events follow when no window is left. A
// vertex then mostly has its final distance before its fan is lit. Events wait in a heap, the nearest
// first and of two as near that of the lower vertex, or in a ring, in the order they came: more
// windows on large disks, but no loops, which lavapipe goes through in every trip. Where the disk trims
// its windows both wait in bands instead.
#ifndef GEODISK_WAITING_GLSL
#define GEODISK_WAITING_GLSL

layout(constant_id = kSpecEventHeap) const bool kEventHeap = false;

uint window_at(uint window) { return kLaneRows + kWindowRows * window; }
uint event_row(uint event) {
    return own_row(first_event + (event & (P.window_capacity - 1u)));
}

// What a window remembers is in this row, as the component of its number modulo 4.
uint remembered_row(uint window) { return own_row(first_remembered + (window >> 2)); }

#include "bands.glsl"

void push_window(float distance, uvec4 row0, uvec4 row1, uint remembered) {
    uint place = place_to_wait();
    if (place >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = window_at(place);
    pool[own_row(at)] = row0;
    pool[own_row(at + 1u)] = row1;
    pool[remembered_row(place)][place & 3u] = remembered;
    ++lane.pushed;
    if (trims()) {
        band_window(distance, place);
    } else {
        lane.most_waiting = max(lane.most_waiting, lane.windows);
    }
}

// Distances are positive, so their words compare as they do.
bool is_nearer(uvec4 a, uvec4 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

// In the heap the events below event i are 2 i + 1 and 2 i + 2.
void push_event(uvec4 row) {
    if (trims()) {
        band_event(row);
        return;
    }
    if (lane.event_tail - lane.event_head >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = lane.event_tail;
    if (kEventHeap) {
        while (at > 0u) {
            uint above = (at - 1u) >> 1;
            uvec4 other = own_row_at(pool, event_row(above));
            if (!is_nearer(row, other)) {
                break;
            }
            pool[event_row(at)] = other;
            at = above;
        }
    }
    pool[event_row(at)] = row;
    ++lane.event_tail;
    ++lane.pushed;
    lane.most_waiting = max(lane.most_waiting, lane.event_tail - lane.event_head);
}

// The last event takes the place of the first, and gives way to nearer ones.
void sink_last() {
    --lane.event_tail;
    uvec4 last = own_row_at(pool, event_row(lane.event_tail));
    uint at = 0u;
    for (uint below = 1u; below < lane.event_tail; below = 2u * at + 1u) {
        uint second = min(below + 1u, lane.event_tail - 1u);
        uvec4 row = own_row_at(pool, event_row(below));
        uvec4 second_row = own_row_at(pool, event_row(second));
        if (is_nearer(second_row, row)) {
            below = second;
            row = second_row;
        }
        if (!is_nearer(row, last)) {
            break;
        }
        pool[event_row(at)] = row;
        at = below;
    }
    pool[event_row(at)] = last;
}

uvec4 pop_event() {
    uvec4 first = own_row_at(pool, event_row(lane.event_head));
    if (kEventHeap) {
        sink_last();
    } else {
        ++lane.event_head;
    }
    return first;
}

#endif
