#version 450
#extension GL_GOOGLE_include_directive : require
// The exact geodesic disk of every active candidate, and the idle and active candidates of higher
// rank in it (paper DetectCollision, sections 3.4 and 3.5). One invocation per slot. It stops after
// push.trip_budget loop iterations and goes on in the next dispatch: some drivers end long loops,
// lavapipe silently.
// reads: half-edges, fans, cells, points, states   writes: pool slice, slots, control, blockers
// spec: local size, rounding

#include "../lib/prelude.glsl"
#include "../lib/rounding.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindFans, readonly, uvec4, fans);
GEODISK_BUFFER(kBindCells, readonly, uint, cells);
GEODISK_BUFFER(kBindPoints, readonly, uvec4, points);
GEODISK_BUFFER(kBindStates, readonly, uint, states);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindPool, , uvec4, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"
#include "../lib/window_heap.glsl"
#include "../lib/vertex_table.glsl"
#include "../lib/propagate.glsl"
#include "../lib/scan.glsl"

// Flags of SlotRec::root.
const uint kRootOpen = 1u;
const uint kRootPending = 2u;

// Table rows emptied per trip of the main loop.
const uint kClearPerTrip = 64u;

uint phase;
uint cursor;     // clear: next table row; source: next edge; fan: next corner
uint cursor_end;
uint own_place;
uint own_face;

void load_slot(uint slot) {
    uint row = slot * kSlotRows;
    uvec4 a = slots[row];
    uvec4 b = slots[row + 1u];
    uvec4 c = slots[row + 2u];
    uvec4 d = slots[row + 3u];
    uvec4 e = slots[row + 4u];
    uvec4 f = slots[row + 5u];
    uvec4 g = slots[row + 6u];
    uvec4 h = slots[row + 7u];
    own_place = a.x, phase = a.y, conflicts = a.z;
    heap_size = b.x, high_water = b.y, vertices = b.z, own_rank = b.w;
    half_edge = c.x, mode = c.y, x = uintBitsToFloat(c.z), y = uintBitsToFloat(c.w);
    b0 = uintBitsToFloat(d.x), b1 = uintBitsToFloat(d.y), sigma = uintBitsToFloat(d.z), chain = d.w;
    window_edge = e.x, cursor = e.y, cursor_end = e.z, entered_by = e.w;
    scan_place = f.x, scan_end = f.y, scan_row = f.z, scan_row_end = f.w;
    scan_column = g.x, scan_columns = g.y, tested = g.z, own_face = g.w;
    pushed = h.x, peak = h.y, longest_chain = h.z;
    root_open = (h.w & kRootOpen) != 0u, has_pending = (h.w & kRootPending) != 0u;
    uvec4 i = slots[row + 8u];
    pending = i.xy, open_window = i.z;
    edge = load_edge(half_edge);
    heap_first = slice_row(slot);
    windows_first = windows_row(slot);
    table_first = table_row(slot);
    list_first = list_row(slot);
    overflow = 0u;
    trips = 0u;
}

void save_slot(uint slot) {
    uint row = slot * kSlotRows;
    slots[row] = uvec4(own_place, phase, conflicts, 0u);
    slots[row + 1u] = uvec4(heap_size, high_water, vertices, own_rank);
    slots[row + 2u] = uvec4(half_edge, mode, floatBitsToUint(x), floatBitsToUint(y));
    slots[row + 3u] =
        uvec4(floatBitsToUint(b0), floatBitsToUint(b1), floatBitsToUint(sigma), chain);
    slots[row + 4u] = uvec4(window_edge, cursor, cursor_end, entered_by);
    slots[row + 5u] = uvec4(scan_place, scan_end, scan_row, scan_row_end);
    slots[row + 6u] = uvec4(scan_column, scan_columns, tested, own_face);
    slots[row + 7u] = uvec4(pushed, peak, longest_chain,
                            (root_open ? kRootOpen : 0u) | (has_pending ? kRootPending : 0u));
    slots[row + 8u] = uvec4(pending, open_window, 0u);
}

void clear_table() {
    uint end = min(cursor + kClearPerTrip, push.table_capacity);
    for (; cursor < end; ++cursor) {
        ++trips;
        pool[table_first + cursor] = uvec4(0u);
    }
    if (cursor == push.table_capacity) {
        phase = kPhaseSource;
        cursor = 0u;
        own_face = points[own_place].w;
    }
}

// Whether a shortest path that came in through corner entered_by may go on into `corner`: it must
// keep an angle of pi on both sides, or on one side of an open fan.
bool in_shadow(uvec4 fan, uint corner) {
    if (entered_by == kWholeFan || (fan.w & kFanIrregular) != 0u) {
        return true;
    }
    uint from = load_turn(entered_by).fan_angles;
    uint to = load_turn(corner).fan_angles;
    uint from_start = from & 0xffffu;
    uint from_end = from_start + (from >> 16);
    uint start = to & 0xffffu;
    uint end = start + (to >> 16);
    bool earlier = start < from_start;
    uint needed = kAnglePi - kAngleTolerance;
    if ((fan.w & kFanOpen) != 0u) {
        return earlier ? from_end - start >= needed : end - from_start >= needed;
    }
    uint left = end - from_start + (earlier ? fan.z : 0u);
    uint right = from_end - start + (!earlier && corner != entered_by ? fan.z : 0u);
    return left >= needed && right >= needed;
}

uint corner_at(uint i) {
    return fans[push.vertices + (i >> 2)][i & 3u];
}

// Takes the nearest window or vertex from the heap; a vertex reached sooner by now is dropped.
void take_nearest() {
    uint window;
    if (!pop_window(window)) {
        phase = kPhaseDone;
        return;
    }
    uint row = windows_first + kWindowRows * window;
    uvec4 row0 = pool[row];
    uvec4 row1 = pool[row + 1u];
    x = uintBitsToFloat(row0.y);
    y = uintBitsToFloat(row0.z);
    b0 = uintBitsToFloat(row0.w);
    b1 = uintBitsToFloat(row1.x);
    sigma = uintBitsToFloat(row1.y);
    chain = row1.z;
    entered_by = row1.w;
    window_edge = row0.x;
    if ((row0.x & kVertexEvent) == 0u) {
        half_edge = window_edge;
        mode = kModeSameWay;
        phase = kPhaseCross;
        return;
    }
    uint vertex = row0.x & ~kVertexEvent;
    uvec4 note;
    find_vertex(vertex, note);
    if (known_distance(note) < sigma) {
        return;
    }
    uvec4 fan = fans[vertex];
    cursor = fan.x;
    cursor_end = fan.x + fan.y;
    phase = kPhaseFan;
}

// Moves on to the next face of the window's edge; false after the last.
bool next_face() {
    uint around = load_turn(half_edge).around;
    bool same_way = (mode == kModeSameWay) == ((around & 1u) != 0u);
    mode = same_way ? kModeSameWay : kModeOpposite;
    half_edge = around >> 1;
    return half_edge != window_edge;
}

// Sets up the next operation; false if there is none in this trip.
bool next_operation(out float source_square) {
    source_square = 0.0;
    if (phase == kPhaseCross && !next_face()) {
        phase = kPhasePop;
    }
    if ((phase == kPhaseFan && cursor == cursor_end) || (phase == kPhaseSource && cursor == 3u)) {
        phase = kPhasePop;
    }
    if (phase == kPhasePop) {
        take_nearest();
        if (phase == kPhaseCross) {
            next_face();
        }
    }
    bool due = phase != kPhasePop && phase != kPhaseDone;
    if (phase == kPhaseFan) {
        uint corner = corner_at(cursor);
        ++cursor;
        half_edge = next_in_face(corner);
        mode = kModeInside;
        due = in_shadow(fans[window_edge & ~kVertexEvent], corner);
    } else if (phase == kPhaseSource) {
        half_edge = 3u * own_face + cursor;
        ++cursor;
        mode = kModeInside;
    }
    edge = load_edge(half_edge);
    if (phase == kPhaseFan) {
        x = edge.apex_x;
        y = edge.apex_y;
    } else if (phase == kPhaseSource) {
        uvec4 point = points[own_place];
        vec2 at =
            position_in(half_edge, edge, uintBitsToFloat(point.x), uintBitsToFloat(point.y));
        x = at.x;
        y = at.y;
        sigma = 0.0;
        chain = 0u;
        source_square = squared(x, y);
    }
    return due;
}

void trip() {
    ++trips;
    if (phase == kPhaseClear) {
        clear_table();
        return;
    }
    if (!scanning()) {
        float source_square;
        if (!next_operation(source_square)) {
            return;
        }
        bool source = phase == kPhaseSource;
        spread(phase == kPhaseFan, source_square, source && root(source_square) <= kNearVertex);
        if (!source || cursor == 1u) {
            begin_scan(entry_x(edge.len), mode == kModeInside ? y : -y);
        }
    }
    scan_some();
}

void count_disk() {
    atomicAdd(control.unfinished, 0xffffffffu);
    atomicAdd(control.disks, 1u);
    uint low = atomicAdd(control.windows_low, pushed);
    if (low + pushed < low) {
        atomicAdd(control.windows_high, 1u);
    }
    low = atomicAdd(control.tested_low, tested);
    if (low + tested < low) {
        atomicAdd(control.tested_high, 1u);
    }
    atomicMax(control.largest_heap, peak);
    atomicMax(control.most_vertices, vertices);
    atomicMax(control.most_conflicts, conflicts);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= control.slots_used || control.unfinished == 0u) {
        return;
    }
    uint stored = slots[slot * kSlotRows].y;
    if (stored >= kPhaseDone) {
        return;
    }
    load_slot(slot);
    do {
        trip();
    } while (trips < push.trip_budget && phase < kPhaseDone && overflow == 0u);
    if (overflow != 0u) {
        phase = kPhaseStuck;
        atomicOr(control.overflow, overflow);
    } else if (phase == kPhaseDone) {
        count_disk();
    }
    save_slot(slot);
}
