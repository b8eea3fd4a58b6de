// What waits in one invocation to be spread, bounded: windows on a stack, and the events of vertices.
// Windows go first, the nearer child of two before the other; events follow when no window is left. A
// vertex then mostly has its final distance before its fan is lit. Events wait in a heap, the nearest
// first and of two as near that of the lower vertex, or in a ring, in the order they came: more
// windows on large disks, but no loops, which lavapipe goes through in every trip.
#ifndef GEODISK_WAITING_GLSL
#define GEODISK_WAITING_GLSL

layout(constant_id = kSpecEventHeap) const bool kEventHeap = false;

uint slice;        // first row of this lane
uint first_event;  // among the rows of this lane
uint windows;      // on the stack
uint event_head;   // events taken from the ring, 0 of the heap
uint event_tail;   // one past the last
uint most_waiting; // most on the stack or of events
uint pushed;       // windows and events ever pushed

// A row of this lane in the pool.
uint own_row(uint at) { return slice + at * kPoolBlock; }
uint window_at(uint window) { return kLaneRows + kWindowRows * window; }
uint event_row(uint event) {
    return own_row(first_event + (event & (P.window_capacity - 1u)));
}

void push_window(uvec4 row0, uvec4 row1) {
    if (windows >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = window_at(windows);
    pool[own_row(at)] = row0;
    pool[own_row(at + 1u)] = row1;
    ++windows;
    ++pushed;
    most_waiting = max(most_waiting, windows);
}

// Distances are positive, so their words compare as they do.
bool is_nearer(uvec4 a, uvec4 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

// In the heap the events below event i are 2 i + 1 and 2 i + 2.
void push_event(uvec4 row) {
    if (event_tail - event_head >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = event_tail;
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
    ++event_tail;
    ++pushed;
    most_waiting = max(most_waiting, event_tail - event_head);
}

// The last event takes the place of the first, and gives way to nearer ones.
void sink_last() {
    --event_tail;
    uvec4 last = own_row_at(pool, event_row(event_tail));
    uint at = 0u;
    for (uint below = 1u; below < event_tail; below = 2u * at + 1u) {
        uint second = min(below + 1u, event_tail - 1u);
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
    uvec4 first = own_row_at(pool, event_row(event_head));
    if (kEventHeap) {
        sink_last();
    } else {
        ++event_head;
    }
    return first;
}

#endif
