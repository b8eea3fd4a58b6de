// The bounded heap of one invocation: 4-ary, entries (key bits, window), least first; ties go to the
// lower window number, so that the order of work is the same everywhere. The entries behind the
// heap's end remember the free windows, the one freed last first.
#ifndef GEODISK_WINDOW_HEAP_GLSL
#define GEODISK_WINDOW_HEAP_GLSL

uint heap_first;    // row of this slot's heap
uint windows_first; // row of this slot's windows
uint heap_size;
uint high_water;    // windows ever in use
uint peak;          // largest heap_size
uint pushed;        // windows ever pushed
uint overflow;      // kOverflow* bits
uint trips;         // loop iterations of this dispatch

bool before(uvec2 a, uvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

uvec2 heap_entry(uint i) {
    uint at = i + 3u;
    uvec4 row = pool[heap_first + (at >> 1)];
    return (at & 1u) == 0u ? row.xy : row.zw;
}

void set_heap_entry(uint i, uvec2 entry) {
    uint row = heap_first + ((i + 3u) >> 1);
    uint half_row = ((i + 3u) & 1u) * 2u;
    pool[row][half_row] = entry.x;
    pool[row][half_row + 1u] = entry.y;
}

// The root may be open: its window was taken, and the entry that follows is decided when the next
// one is taken. Mostly that is the first window pushed meanwhile, which then costs one way down
// instead of a way down and a way up.
bool root_open;
bool has_pending;
uvec2 pending;      // what goes into the open root; its window is the one taken
uint open_window;   // the window taken from the open root

// Fills the open root: with the pending entry, or with the heap's last.
void close_root() {
    uvec2 entry = pending;
    if (!has_pending) {
        --heap_size;
        entry = heap_entry(heap_size);
        set_heap_entry(heap_size, uvec2(0u, open_window));
    }
    uint hole = 0u;
    for (;;) {
        ++trips;
        uint child = 4u * hole + 1u;
        if (child >= heap_size) {
            break;
        }
        uint row = heap_first + ((child + 3u) >> 1);
        uvec4 front = pool[row];
        uvec4 back = pool[row + 1u];
        uvec2 least = front.xy;
        uint least_child = child;
        if (child + 1u < heap_size && before(front.zw, least)) {
            least = front.zw;
            least_child = child + 1u;
        }
        if (child + 2u < heap_size && before(back.xy, least)) {
            least = back.xy;
            least_child = child + 2u;
        }
        if (child + 3u < heap_size && before(back.zw, least)) {
            least = back.zw;
            least_child = child + 3u;
        }
        if (!before(least, entry)) {
            break;
        }
        set_heap_entry(hole, least);
        hole = least_child;
    }
    if (heap_size > 0u) {
        set_heap_entry(hole, entry);
    }
    root_open = false;
    has_pending = false;
}

// Takes the least entry and returns its window, whose rows stay readable until the next push; false
// if the heap is empty.
bool pop_window(out uint window) {
    if (root_open) {
        close_root();
    }
    window = heap_entry(0u).y;
    if (heap_size == 0u) {
        return false;
    }
    root_open = true;
    open_window = window;
    return true;
}

void push_window(float key, uvec4 row0, uvec4 row1) {
    uint window = open_window;
    bool fills_root = root_open && !has_pending;
    if (!fills_root) {
        if (heap_size >= push.window_capacity) {
            overflow |= kOverflowWindows;
            return;
        }
        window = high_water;
        if (heap_size < high_water) {
            window = heap_entry(heap_size).y;
        } else {
            ++high_water;
        }
    }
    pool[windows_first + kWindowRows * window] = row0;
    pool[windows_first + kWindowRows * window + 1u] = row1;
    ++pushed;
    uvec2 entry = uvec2(floatBitsToUint(key), window);
    if (fills_root) {
        pending = entry;
        has_pending = true;
        return;
    }
    uint hole = heap_size;
    while (hole > (root_open ? 4u : 0u)) {
        ++trips;
        uint parent = (hole - 1u) >> 2;
        uvec2 above = heap_entry(parent);
        if (!before(entry, above)) {
            break;
        }
        set_heap_entry(hole, above);
        hole = parent;
    }
    set_heap_entry(hole, entry);
    ++heap_size;
    peak = max(peak, heap_size);
}

#endif
