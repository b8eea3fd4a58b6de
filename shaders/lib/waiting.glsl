// What waits in one invocation to be spread, bounded: windows on a stack, and the events of vertices
// in a ring. Windows go first, the nearer child of two before the other; events follow in the order
// they came, when no window is left. A vertex then mostly has its final distance before its fan is
// lit, and fewer windows are made than by always taking the nearest, at no cost for keeping order.
#ifndef GEODISK_WAITING_GLSL
#define GEODISK_WAITING_GLSL

uint slice;        // first row of this lane
uint first_event;  // among the rows of this lane
uint windows;      // on the stack
uint event_head;   // events taken
uint event_tail;   // events pushed
uint most_waiting; // most on the stack or in the ring
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

void push_event(uvec4 row) {
    if (event_tail - event_head >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    pool[event_row(event_tail)] = row;
    ++event_tail;
    ++pushed;
    most_waiting = max(most_waiting, event_tail - event_head);
}

#endif
