#version 450
#extension GL_GOOGLE_include_directive : require
// The exact geodesic disk of every active candidate, and the idle and active candidates in it (paper
// DetectCollision, sections 3.4 and 3.5). One invocation per slot. It stops after push.trip_budget
// trips and goes on in the next dispatch: some drivers end long loops, lavapipe silently. The number
// of iterations one trip can take is bounded, see kIterationsPerTrip.
// reads: faces, fans, cells, states, weights   writes: pool slice, slots, control
// spec: local size, rounding
//
// lavapipe executes both sides of every branch, so a trip is one straight line of as few loads and
// stores as possible: it takes one window or corner, spreads it, and scans.

#include "../lib/prelude.glsl"
#include "../lib/rounding.glsl"
#include "../lib/weights.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindFans, readonly, uvec4, fans);
GEODISK_BUFFER(kBindCells, readonly, uint, cells);
GEODISK_BUFFER(kBindStates, readonly, uint, states);
GEODISK_BUFFER(kBindWeights, readonly, uint, weights);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindPool, , uvec4, pool);
GEODISK_CONTROL;

// A copy that stays in registers; reading push constants in a branch is a gather on lavapipe.
Push P;

#include "../lib/slice.glsl"
#include "../lib/waiting.glsl"
#include "../lib/vertex_table.glsl"
#include "../lib/propagate.glsl"
#include "../lib/scan.glsl"

uint cursor;        // clear: next table row; source: next edge; fan: next corner
uint cursor_end;
uint own_rank;
uint own_face;
vec2 own_weights;

// The vertex whose fan is walked.
uint corner_ahead;  // lit corner that comes next
uint entered_by;    // corner its path came in through, or kWholeFan
uint entry_angles;
uint fan_angle;
uint fan_flags;

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
    uvec4 i = slots[row + 8u];
    uvec4 j = slots[row + 9u];
    own_place = a.x, phase = a.y, idle_conflicts = a.z, active_conflicts = a.w;
    own_rank = b.x, own_face = b.y, own_weights = uintBitsToFloat(b.zw);
    windows = c.x, event_head = c.y, event_tail = c.z;
    half_edge = d.x, mode = d.y, x = uintBitsToFloat(d.z), y = uintBitsToFloat(d.w);
    b0 = uintBitsToFloat(e.x), b1 = uintBitsToFloat(e.y), sigma = uintBitsToFloat(e.z), chain = e.w;
    known = f.x, cursor = f.y, cursor_end = f.z, corner_ahead = f.w;
    scan_place = g.x, scan_end = g.y, scan_row = g.z, scan_row_end = g.w;
    scan_columns = h.x, scan_stride = h.y, tested = h.z, pushed = h.w;
    most_waiting = i.x, longest_chain = i.y, vertices = i.z;
    entered_by = j.x, entry_angles = j.y, fan_angle = j.z, fan_flags = j.w;
    windows_first = slice_row(slot);
    events_first = events_row(slot);
    table_first = table_row(slot);
    list_first = list_row(slot);
    overflow = 0u;
}

void save_slot(uint slot) {
    uint row = slot * kSlotRows;
    slots[row] = uvec4(own_place, phase, idle_conflicts, active_conflicts);
    slots[row + 1u] = uvec4(own_rank, own_face, floatBitsToUint(own_weights));
    slots[row + 2u] = uvec4(windows, event_head, event_tail, 0u);
    slots[row + 3u] = uvec4(half_edge, mode, floatBitsToUint(x), floatBitsToUint(y));
    slots[row + 4u] =
        uvec4(floatBitsToUint(b0), floatBitsToUint(b1), floatBitsToUint(sigma), chain);
    slots[row + 5u] = uvec4(known, cursor, cursor_end, corner_ahead);
    slots[row + 6u] = uvec4(scan_place, scan_end, scan_row, scan_row_end);
    slots[row + 7u] = uvec4(scan_columns, scan_stride, tested, pushed);
    slots[row + 8u] = uvec4(most_waiting, longest_chain, vertices, 0u);
    slots[row + 9u] = uvec4(entered_by, entry_angles, fan_angle, fan_flags);
}

void clear_table() {
    uint end = min(cursor + kClearPerDispatch, P.table_capacity);
    for (; cursor < end; ++cursor) {
        pool[table_first + cursor] = uvec4(0u);
    }
    if (cursor == P.table_capacity) {
        phase = kPhaseSource;
        cursor = 0u;
        mode = kModeInside;
    }
}

// Half-edge and angles of a corner of the fans.
uvec2 fan_corner(uint i) {
    uvec4 row = fans[P.vertices + (i >> 1)];
    return (i & 1u) == 0u ? row.xy : row.zw;
}

uint corner_angles(uint h) {
    uint corners = 3u * P.faces;
    return fans[P.vertices + ((corners + 1u) >> 1) + (h >> 2)][h & 3u];
}

// Whether a shortest path that came in through corner entered_by may go on into `corner`: it must
// keep an angle of pi on both sides, or on one side of an open fan.
bool in_shadow(uvec2 corner) {
    if (entered_by == kWholeFan || (fan_flags & kFanIrregular) != 0u) {
        return true;
    }
    uint from_start = entry_angles & 0xffffu;
    uint from_end = from_start + (entry_angles >> 16);
    uint start = corner.y & 0xffffu;
    uint end = start + (corner.y >> 16);
    bool earlier = start < from_start;
    uint needed = kAnglePi - kAngleTolerance;
    if ((fan_flags & kFanOpen) != 0u) {
        return earlier ? from_end - start >= needed : end - from_start >= needed;
    }
    uint turned_left = end - from_start + (earlier ? fan_angle : 0u);
    uint turned_right =
        from_end - start + (!earlier && corner.x != entered_by ? fan_angle : 0u);
    return turned_left >= needed && turned_right >= needed;
}

void take_window() {
    --windows;
    uint row = windows_first + kWindowRows * windows;
    uvec4 row0 = pool[row];
    uvec4 row1 = pool[row + 1u];
    half_edge = row0.x >> 1;
    mode = (row0.x & 1u) != 0u ? kModeSameWay : kModeOpposite;
    x = uintBitsToFloat(row0.y);
    y = uintBitsToFloat(row0.z);
    b0 = uintBitsToFloat(row0.w);
    b1 = uintBitsToFloat(row1.x);
    sigma = uintBitsToFloat(row1.y);
    chain = row1.z;
    known = row1.w;
    phase = kPhaseCross;
}

// A vertex reached sooner by now is dropped.
void take_event() {
    uvec4 row = pool[event_row(event_head)];
    ++event_head;
    uint vertex = row.x;
    uvec4 note;
    find_vertex(vertex, note);
    if (known_distance(note) < uintBitsToFloat(row.y)) {
        return;
    }
    sigma = uintBitsToFloat(row.y);
    chain = row.z;
    entered_by = row.w;
    uvec4 fan = fans[vertex];
    cursor = fan.x;
    cursor_end = fan.x + fan.y;
    fan_angle = fan.z;
    fan_flags = fan.w;
    entry_angles = entered_by == kWholeFan ? 0u : corner_angles(entered_by);
    corner_ahead = kNoHalfEdge;
    mode = kModeInside;
    phase = kPhaseFan;
}

// The next lit corner of the fan, or none; looks one lit corner ahead, to tell when it is the last.
uint next_lit_corner() {
    uint corner = corner_ahead;
    corner_ahead = kNoHalfEdge;
    for (uint i = 0u; i < kCornersPerTrip && cursor < cursor_end && corner_ahead == kNoHalfEdge;
         ++i) {
        uvec2 next = fan_corner(cursor);
        ++cursor;
        if (in_shadow(next)) {
            corner_ahead = corner == kNoHalfEdge ? kNoHalfEdge : next.x;
            corner = corner == kNoHalfEdge ? next.x : corner;
        }
    }
    return corner;
}

// Chooses the face of the next operation; false if there is none in this trip.
bool next_operation() {
    if (phase == kPhaseCross) {
        bool same_way = (mode == kModeSameWay) == ((edge_around & 1u) != 0u);
        mode = same_way ? kModeSameWay : kModeOpposite;
        half_edge = edge_around >> 1;
    }
    if (phase == kPhasePop) {
        if (windows > 0u) {
            take_window();
        } else if (event_head != event_tail) {
            take_event();
        } else {
            phase = kPhaseBlock;
            cursor = 0u;
        }
    }
    if (phase == kPhaseFan) {
        uint corner = next_lit_corner();
        if (corner == kNoHalfEdge) {
            phase = cursor == cursor_end ? kPhasePop : kPhaseFan;
            return false;
        }
        half_edge = next_in_face(corner);
    }
    if (phase == kPhaseSource) {
        half_edge = 3u * own_face + cursor;
        ++cursor;
    }
    return phase == kPhaseSource || phase == kPhaseCross || phase == kPhaseFan;
}

// Where the source of an operation inside the face lies; returns the squared distance of the
// candidate from the start of half_edge.
float place_source() {
    if (phase == kPhaseFan) {
        x = apex.x;
        y = apex.y;
    }
    if (phase == kPhaseSource) {
        vec2 at =
            position_in(half_edge % 3u, edge.len, apex, own_weights.x, own_weights.y);
        x = at.x;
        y = at.y;
        sigma = 0.0;
        chain = 0u;
    }
    return phase == kPhaseSource ? squared(x, y) : 0.0;
}

// What follows the operation just set up, once its candidates are scanned.
void follow_up() {
    if (phase == kPhaseSource) {
        phase = cursor == 3u ? kPhasePop : kPhaseSource;
    } else if (phase == kPhaseFan) {
        phase = corner_ahead == kNoHalfEdge && cursor == cursor_end ? kPhasePop : kPhaseFan;
    } else if (phase == kPhaseCross) {
        // On to the next face of the edge, if that is not the one the window came from.
        bool more = (edge.origin & kManyFaces) != 0u && edge_around >> 1 != known;
        phase = more ? kPhaseCross : kPhasePop;
    }
}

void trip() {
    bool due = !scanning() && next_operation();
    load_face();
    if (due) {
        float source_square = place_source();
        spread(source_square);
        if (phase != kPhaseSource || cursor == 1u) {
            begin_scan(entry_x(), mode == kModeInside ? y : -y);
        }
    }
    scan_some();
    if (due) {
        follow_up();
    }
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    P = push;
    if (slot >= control.slots_used || control.unfinished == 0u) {
        return;
    }
    uint stored = slots[slot * kSlotRows].y;
    if (stored >= kPhaseBlock) {
        return;
    }
    load_slot(slot);
    load_face();
    if (phase == kPhaseClear) {
        clear_table();
    }
    for (uint i = 0u; i < P.trip_budget && phase != kPhaseClear && phase < kPhaseBlock &&
                      overflow == 0u; ++i) {
        trip();
    }
    if (overflow != 0u) {
        phase = kPhaseStuck;
        atomicOr(control.overflow, overflow);
    }
    save_slot(slot);
}
