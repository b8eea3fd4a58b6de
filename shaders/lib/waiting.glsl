// Work that waits in a lane, with fixed capacity: windows on a stack, and vertex events. Windows go
// first, the nearer child of two before the other; events follow when no window is left. Most vertices
// then have their final distance before their fan is lit.
//
// Events wait in a heap, nearest first, and of equally near ones the lower vertex. Or they wait in a
// ring, oldest first: this makes more windows on large disks, but has no loops, which lavapipe runs in
// every trip. If the disk trims its windows, they wait in the heap too, so that they meet those that
// trim them: as rows (kWindowWaits, distance, place, number), since equally near ones go in the order
// they came.
#ifndef GEODISK_WAITING_GLSL
#define GEODISK_WAITING_GLSL

layout(constant_id = kSpecEventHeap) const bool kEventHeap = false;

bool trims() { return kTrims && lane.trims != 0u; }

// Returns by how much a window may be nearer than the one that trims it.
float trim_error() {
    precise float of_long_edges = job.base_error * kTrimPart;
    return max(kTrimError, of_long_edges);
}

// Returns the bound on the error that a crossing adds to a distance: with its rounding, and what trims it.
float crossing_error() {
    precise float trimming = kTrimError + trim_error();
    return trims() ? trimming : kCrossingError;
}

bool holds_window() { return kHolds && lane.held_around != kNoWindow; }

// Returns the windows on the stack and the one held.
uint windows_waiting() { return lane.windows + (holds_window() ? 1u : 0u); }

uint window_at(uint window) { return kLaneRows + kWindowRows * window; }
uint event_row(uint event) {
    return own_row(first_event + (event & (push.window_capacity - 1u)));
}

// Returns the row of what a window remembers, in the component of its number modulo 4, if there is one.
uint remembered_row(uint window) { return own_row(first_remembered + (window >> 2)); }

// Returns a free place for a window; the capacity if there is none. Free places are linked.
uint free_window() {
    bool again = trims() && lane.free_place != kNoWindow;
    uint place = again ? lane.free_place : lane.windows;
    if (again) {
        lane.free_place = own_row_at(pool, own_row(window_at(place))).x;
    } else if (place < push.window_capacity) {
        ++lane.windows;
    }
    return place;
}

void give_back_window(uint place) {
    pool[own_row(window_at(place))].x = lane.free_place;
    lane.free_place = place;
}

// Distances are positive, so their words compare like them.
bool is_nearer(uvec4 a, uvec4 b) {
    bool comes_first = a.x < b.x || (a.x == b.x && a.w < b.w);
    return a.y < b.y || (a.y == b.y && comes_first);
}

// Pushes an event. In the heap, the children of i are 2 i + 1 and 2 i + 2.
void put_event(uvec4 row) {
    if (lane.event_tail - lane.event_head >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = lane.event_tail;
    if (kEventHeap || trims()) {
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
    lane.max_waiting = max(lane.max_waiting, lane.event_tail - lane.event_head);
}

void push_event(uvec4 row) {
    put_event(row);
    ++lane.pushed;
}

void push_window(float distance, uvec4 row0, uvec4 row1, uint remembered) {
    uint place = free_window();
    if (place >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint at = window_at(place);
    pool[own_row(at)] = row0;
    pool[own_row(at + 1u)] = row1;
    if (kTrims) {
        pool[remembered_row(place)][place & 3u] = remembered;
    }
    if (trims()) {
        put_event(uvec4(kWindowWaits, floatBitsToUint(distance), place, lane.pushed));
    } else {
        lane.max_waiting = max(lane.max_waiting, windows_waiting());
    }
    ++lane.pushed;
}

// Holds the window that is taken next instead of pushing it.
void hold_window(uvec4 row0, uvec4 row1) {
    lane.held_around = row0.x;
    lane.held_x = uintBitsToFloat(row0.y);
    lane.held_y = uintBitsToFloat(row0.z);
    lane.held_b0 = uintBitsToFloat(row0.w);
    lane.held_b1 = uintBitsToFloat(row1.x);
    lane.held_known = row1.w;
    lane.max_waiting = max(lane.max_waiting, windows_waiting());
    ++lane.pushed;
}

// Moves the last event to the front of the heap and sinks it below nearer ones.
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
    if (kEventHeap || trims()) {
        sink_last();
    } else {
        ++lane.event_head;
    }
    return first;
}

#endif
