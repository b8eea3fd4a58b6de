#version 450
#extension GL_GOOGLE_include_directive : require
// The exact geodesic disk of every active candidate, and the idle and active candidates in it (paper
// DetectCollision, sections 3.4 and 3.5). One invocation per lane: it takes one slot after the other,
// so that a large disk holds up no small ones. It stops after push.step_budget steps and goes on in
// the next dispatch: some drivers end long loops, lavapipe silently. The number of iterations of a
// step is bounded, see kIterationsPerStep.
// reads: faces, fans, radii, cells, states, weights, orders   writes: pool, slots, control
// spec: local size, rounding, pool block, counted lanes, adaptive, event heap
//
// lavapipe executes both sides of every branch, so a trip is one straight line of as few loads and
// stores as possible: it takes one window or corner, spreads it, and scans.

#include "../lib/prelude.glsl"
#include "../lib/rounding.glsl"
#include "../lib/weights.glsl"
#include "../lib/radii.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = kSpecCountedLanes) const uint kCountedLanes = 0u;

GEODISK_WORDS(kBindCells, cells);
GEODISK_WORDS(kBindStates, states);
GEODISK_WORDS(kBindWeights, weights);
GEODISK_WORDS(kBindOrders, orders);
GEODISK_OWN_ROWS(kBindPool, kBindPoolTexels, pool);
GEODISK_CONTROL;

// A copy that stays in registers; reading push constants in a branch is a gather on lavapipe.
Push P;

#include "../lib/slice.glsl"
#include "../lib/list.glsl"
#include "../lib/waiting.glsl"
#include "../lib/vertex_table.glsl"
#include "../lib/propagate.glsl"
#include "../lib/scan.glsl"
#include "../lib/complete.glsl"
#include "../lib/disk_totals.glsl"

uint slot;
uint trips;         // in this dispatch
uint cursor;        // clear: next table row; source: next edge; fan: next corner
uint cursor_end;
uint own_face;
vec2 own_weights;

// The vertex whose fan is walked.
uint corner_ahead;  // lit corner that comes next
uint entered_by;    // corner its path came in through, or kWholeFan
uint entry_angles;
uint fan_angle;
uint fan_flags;

void load_candidate() {
    own_place = slots[slot].place;
    own_face = slots[slot].face;
    own_weights = uintBitsToFloat(uvec2(slots[slot].weight1, slots[slot].weight2));
    list_first = list_row(slot);
    if (kAdaptive) {
        own_radius = radius_at(face_radii(own_face), own_weights.x, own_weights.y);
    }
}

void load_lane(uint lane) {
    slice = first_row(lane);
    uvec4 a = own_row_at(pool, own_row(0u));
    uvec4 b = own_row_at(pool, own_row(1u));
    uvec4 c = own_row_at(pool, own_row(2u));
    uvec4 d = own_row_at(pool, own_row(3u));
    uvec4 e = own_row_at(pool, own_row(4u));
    uvec4 f = own_row_at(pool, own_row(5u));
    uvec4 g = own_row_at(pool, own_row(6u));
    uvec4 h = own_row_at(pool, own_row(7u));
    uvec4 i = own_row_at(pool, own_row(8u));
    slot = a.x, phase = a.y, idle_conflicts = a.z, active_conflicts = a.w;
    windows = b.x, event_head = b.y, event_tail = b.z, generation = b.w;
    half_edge = c.x, mode = c.y, x = uintBitsToFloat(c.z), y = uintBitsToFloat(c.w);
    b0 = uintBitsToFloat(d.x), b1 = uintBitsToFloat(d.y), sigma = uintBitsToFloat(d.z), chain = d.w;
    known = e.x, cursor = e.y, cursor_end = e.z, corner_ahead = e.w;
    scan_place = f.x, scan_end = f.y, scan_row = f.z, scan_row_end = f.w;
    scan_columns = g.x, scan_stride = g.y, tested = g.z, pushed = g.w;
    most_waiting = h.x, longest_chain = h.y, vertices = h.z;
    entered_by = i.x, entry_angles = i.y, fan_angle = i.z, fan_flags = i.w;
    first_event = kLaneRows + kWindowRows * P.window_capacity;
    first_vertex = first_event + P.window_capacity;
    overflow = 0u;
    load_candidate();
    load_face();
}

void save_lane() {
    pool[own_row(0u)] = uvec4(slot, phase, idle_conflicts, active_conflicts);
    pool[own_row(1u)] = uvec4(windows, event_head, event_tail, generation);
    pool[own_row(2u)] = uvec4(half_edge, mode, floatBitsToUint(x), floatBitsToUint(y));
    pool[own_row(3u)] =
        uvec4(floatBitsToUint(b0), floatBitsToUint(b1), floatBitsToUint(sigma), chain);
    pool[own_row(4u)] = uvec4(known, cursor, cursor_end, corner_ahead);
    pool[own_row(5u)] = uvec4(scan_place, scan_end, scan_row, scan_row_end);
    pool[own_row(6u)] = uvec4(scan_columns, scan_stride, tested, pushed);
    pool[own_row(7u)] = uvec4(most_waiting, longest_chain, vertices, 0u);
    pool[own_row(8u)] = uvec4(entered_by, entry_angles, fan_angle, fan_flags);
}

void hand_in_slot() {
    slots[slot].phase = kSlotListed;
    slots[slot].idle_conflicts = idle_conflicts;
    slots[slot].active_conflicts = active_conflicts;
    slots[slot].longest_chain = longest_chain;
    phase = kPhaseIdle;
    ++own_disks.disks;
    own_disks.windows += pushed;
    own_disks.tested += tested;
    own_disks.most_waiting = max(own_disks.most_waiting, most_waiting);
    own_disks.most_vertices = max(own_disks.most_vertices, vertices);
    own_disks.most_conflicts = max(own_disks.most_conflicts, idle_conflicts + active_conflicts);
    complete_one();
}

// Counts the candidate among the blocks of the active ones behind it in its disk.
void block_conflicts() {
    uvec4 own = sample_of(slot);
    uint end = min(cursor + kBlocksPerStep, active_conflicts);
    for (; cursor < end; ++cursor) {
        uint at = active_entry(P.list_capacity, cursor);
        uint place = own_row_at(pool, list_first + (at >> 2))[at & 3u];
        block(own, place);
    }
    phase = cursor == active_conflicts ? kPhaseComplete : kPhaseBlock;
}

bool slots_left() { return atomic_load(control.next_slot) < control.slots_used; }

void take_slot() {
    uint next = atomicAdd(control.next_slot, 1u);
    if (next >= control.slots_used) {
        return;
    }
    if (is_void(next)) {
        complete_one();
        return;
    }
    slot = next;
    load_candidate();
    idle_conflicts = 0u;
    active_conflicts = 0u;
    windows = 0u;
    event_head = 0u;
    event_tail = 0u;
    scan_place = 0u;
    scan_end = 0u;
    scan_row = 0u;
    scan_row_end = 0u;
    tested = 0u;
    pushed = 0u;
    most_waiting = 0u;
    longest_chain = 0u;
    vertices = 0u;
    cursor = 0u;
    mode = kModeInside;
    bool wrapped = generation == kMostGenerations;
    generation = wrapped ? 1u : generation + 1u;
    phase = wrapped ? kPhaseClear : kPhaseSource;
}

void clear_table() {
    uint end = min(cursor + kClearPerStep, P.table_capacity);
    for (; cursor < end; ++cursor) {
        pool[vertex_row(cursor)] = uvec4(0u);
    }
    if (cursor == P.table_capacity) {
        phase = kPhaseSource;
        cursor = 0u;
    }
}

// Half-edge and angles of a corner of the fans.
uvec2 fan_corner(uint i) {
    uvec4 row = row_at(fans, P.vertices + (i >> 1));
    return (i & 1u) == 0u ? row.xy : row.zw;
}

uint corner_angles(uint h) {
    uint corners = 3u * P.faces;
    return row_at(fans, P.vertices + ((corners + 1u) >> 1) + (h >> 2))[h & 3u];
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
    uint at = window_at(windows);
    uvec4 row0 = own_row_at(pool, own_row(at));
    uvec4 row1 = own_row_at(pool, own_row(at + 1u));
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
    uvec4 row = pop_event();
    uint vertex = row.x;
    if (find_vertex(vertex).distance < uintBitsToFloat(row.y)) {
        return;
    }
    sigma = uintBitsToFloat(row.y);
    chain = row.z;
    entered_by = row.w;
    uvec4 fan = row_at(fans, vertex);
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

bool running() { return phase > kPhaseClear && phase < kPhaseBlock && overflow == 0u; }

// Takes a slot if the lane has none, works on it, and hands it in if it is done.
void step() {
    if (phase == kPhaseIdle && slots_left()) {
        take_slot();
    }
    if (phase == kPhaseClear) {
        clear_table();
    }
    for (uint i = 0u; i < kTripsPerStep && running(); ++i) {
        trip();
        ++trips;
    }
    if (phase == kPhaseBlock) {
        block_conflicts();
    }
    if (phase == kPhaseComplete) {
        hand_in_slot();
    }
}

void work_on(uint lane) {
    load_lane(lane);
    for (uint i = 0u; i < P.step_budget && overflow == 0u; ++i) {
        step();
        if (phase == kPhaseIdle && !slots_left()) {
            break;
        }
    }
    if (overflow != 0u) {
        atomicOr(control.overflow, overflow);
    }
    save_lane();
}

shared uint most_trips[gl_WorkGroupSize.x]; // of the lanes of each subgroup

// The lanes of a subgroup go on together until the last has done its trips.
void count_trips() {
    uint invocation = gl_LocalInvocationID.x;
    uint subgroup = invocation / kCountedLanes;
    most_trips[invocation] = 0u;
    barrier();
    atomicMax(most_trips[subgroup], trips);
    GEODISK_ADD_WIDE(control.trips_low, control.trips_high, trips)
    barrier();
    uint most = most_trips[subgroup];
    GEODISK_ADD_WIDE(control.lane_trips_low, control.lane_trips_high, most)
}

void main() {
    uint lane = gl_GlobalInvocationID.x;
    P = push;
    trips = 0u;
    own_disks = kNoDisks;
    if (lane < P.lanes && atomic_load(control.incomplete) > 0u &&
        atomic_load(control.overflow) == 0u) {
        work_on(lane);
    }
    sum_disks();
    if (kCountedLanes > 0u) {
        count_trips();
    }
}
