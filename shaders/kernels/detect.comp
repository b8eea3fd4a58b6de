#version 450
#extension GL_GOOGLE_include_directive : require
// The exact geodesic disk of every active candidate, and the idle and active candidates in it (paper
// DetectCollision, sections 3.4 and 3.5). One invocation per lane: it takes one slot after the other,
// so that a large disk holds up no small ones. It stops after push.step_budget steps and goes on in
// the next dispatch: some drivers end long loops, lavapipe silently. The number of iterations of a
// step is bounded, see kIterationsPerStep.
// reads: faces, fans, radii, cells, weights, orders   writes: pool, slots, control
// spec: local size, rounding, pool block, counted lanes, adaptive, event heap, trims, many rows, avoids, classes,
//       points
//
// lavapipe executes both sides of every branch, so a trip is one straight line of as few loads and
// stores as possible: it takes one window or corner, spreads it, and scans.
//
// Compiled with GEODISK_LIGHT it is the kernel `light`: the disks of settled samples, which list no
// candidates but record how they light each face. With GEODISK_REACH it is the kernel `reach`: such disks
// record the vertices, or the candidates, that they reach, and how far these are.

#define GEODISK_KEEPS_CONSTANTS
#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/rounding.glsl"
#include "../lib/weights.glsl"
#include "../lib/radii.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 4) in; // kSpecSlotLocalSize
layout(constant_id = kSpecCountedLanes) const uint kCountedLanes = 0u;

#ifndef GEODISK_LIGHT
GEODISK_WORDS(kBindCells, cells);
#ifndef GEODISK_REACH
GEODISK_WORDS(kBindWeights, weights);
#endif
GEODISK_WORDS(kBindOrders, orders);
#endif
GEODISK_OWN_ROWS(kBindPool, kBindPoolTexels, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"
#include "../lib/lane.glsl"
#include "../lib/list.glsl"
#include "../lib/waiting.glsl"
#include "../lib/vertex_table.glsl"
#ifdef GEODISK_REACH
#include "../lib/hits.glsl"
#endif
#include "../lib/propagate.glsl"
#include "../lib/shadow.glsl"
#include "../lib/trim.glsl"

#ifdef GEODISK_LIGHT
#include "../lib/light.glsl"
#else
#ifndef GEODISK_REACH
const bool kScans = true;

void note_conflict(uint place, bool is_active, bool conflicts, float square) {
    list_conflict(lane.idle_conflicts, lane.active_conflicts, place, is_active, conflicts);
}
#endif

#include "../lib/scan.glsl"
#endif
#include "../lib/source.glsl"
#include "../lib/complete.glsl"
#include "../lib/disk_totals.glsl"

uint trips; // in this dispatch

void hand_in_slot() {
    slots[lane.slot].phase = kSlotListed;
    slots[lane.slot].idle_conflicts = lane.idle_conflicts;
    slots[lane.slot].active_conflicts = lane.active_conflicts;
    slots[lane.slot].longest_chain = lane.longest_chain;
    lane.phase = kPhaseIdle;
    add_disk(lane.pushed, lane.tested, lane.max_waiting, lane.vertices,
             lane.idle_conflicts + lane.active_conflicts);
    complete_one();
}

#if defined(GEODISK_LIGHT) || defined(GEODISK_REACH)
void block_conflicts() { lane.phase = kPhaseComplete; }
#else
// Counts the candidate among the blocks of the active ones behind it in its disk.
void block_conflicts() {
    uvec4 own = sample_of(lane.slot);
    uint end = min(lane.cursor + kBlocksPerStep, lane.active_conflicts);
    for (; lane.cursor < end; ++lane.cursor) {
        uint at = active_entry(push.list_capacity, lane.cursor);
        uint place = own_row_at(pool, list_first + (at >> 2))[at & 3u];
        block(own, place);
    }
    lane.phase = lane.cursor == lane.active_conflicts ? kPhaseComplete : kPhaseBlock;
}
#endif

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
    begin_disk(next);
    load_candidate(lane.slot);
}

// And the windows kept, which lie behind it.
void clear_table() {
    uint rows = push.table_capacity + (kTrims ? kTrimRows : 0u);
    uint end = min(lane.cursor + kClearPerStep, rows);
    for (; lane.cursor < end; ++lane.cursor) {
        pool[vertex_row(lane.cursor)] = uvec4(0u);
    }
    if (lane.cursor == rows) {
        lane.phase = kPhaseSource;
        lane.cursor = 0u;
    }
}

// The window with these rows is in flight.
void cross_from(uvec4 row0, uvec4 row1) {
    lane.half_edge = row0.x >> 1;
    lane.mode = (row0.x & 1u) != 0u ? kModeSameWay : kModeOpposite;
    lane.x = uintBitsToFloat(row0.y);
    lane.y = uintBitsToFloat(row0.z);
    lane.b0 = uintBitsToFloat(row0.w);
    lane.b1 = uintBitsToFloat(row1.x);
    lane.sigma = uintBitsToFloat(row1.y);
    lane.chain = row1.z;
    lane.known = row1.w;
    lane.phase = kPhaseCross;
    window_taken = true;
}

void take_window(uint window) {
    uint at = window_at(window);
    cross_from(own_row_at(pool, own_row(at)), own_row_at(pool, own_row(at + 1u)));
    if (kTrims) {
        lane.remembered = own_row_at(pool, remembered_row(window))[window & 3u];
    }
}

void take_held() {
    cross_from(uvec4(lane.held_around, floatBitsToUint(lane.held_x), floatBitsToUint(lane.held_y),
                     floatBitsToUint(lane.held_b0)),
               uvec4(floatBitsToUint(lane.held_b1), floatBitsToUint(lane.sigma), lane.chain + 1u,
                     lane.held_known));
    lane.held_around = kNoWindow;
}

// A vertex reached sooner by now is dropped.
void take_event(uvec4 row) {
    uint vertex = row.x;
    if (find_vertex(vertex).distance < uintBitsToFloat(row.y)) {
        return;
    }
    lane.sigma = uintBitsToFloat(row.y);
    lane.chain = row.z >> kChainShift;
    uvec4 fan = row_at(fans, vertex);
    lane.cursor = fan.x;
    lane.cursor_end = fan.x + fan.y;
    enter_fan(fan.z, fan.w, row.w, row.z & kArrivalMask);
    lane.corner_ahead = kNoHalfEdge;
    lane.mode = kModeInside;
    lane.phase = kPhaseFan;
}

// Ends a disk that does not end. It is an error only if its candidate is accepted: until that is known,
// candidates after it are not active.
void put_aside() {
    overflow &= ~kOverflowEndless;
    lane.longest_chain = kEndless;
    lane.idle_conflicts = 0u;
    lane.active_conflicts = 0u;
    lane.phase = kPhaseComplete;
    atomicMin(control.first_left, slots[lane.slot].order + 1u);
}

// Leaves the disk to a work group, which begins it anew.
void leave_to_group() {
    overflow = 0u;
    uint at = atomicAdd(control.large, 1u);
    atomicAdd(control.large_disks, 1u);
    slots[at].scan_place = lane.slot;
    control.large_x = push.large_groups;
    control.large_y = 1u;
    control.large_z = 1u;
    lane.phase = kPhaseIdle;
}

// Returns true if the disk is to have no more windows as it is.
bool is_large() {
    return makes_many(kUntrimmedWindows, lane.vertices, lane.longest_chain, lane.pushed) ||
           (!kTrims && lane.pushed > push.large_after);
}

// Takes what comes next of all that waits. Once there were very many windows the disk begins again:
// trimming, with those listed that it has found, or by a work group.
void take_next() {
    if (!trims() && is_large()) {
        if (kTrims) {
            lane.trims = lane.pushed;
            begin_windows();
        } else {
            overflow |= kOverflowTrims;
        }
    } else if (is_endless() || (trims() && is_void(lane.slot))) {
        overflow |= kOverflowEndless;
    } else if (holds_window()) {
        take_held();
    } else if (!trims() && lane.windows > 0u) {
        --lane.windows;
        take_window(lane.windows);
    } else if (lane.event_head != lane.event_tail) {
        uvec4 row = pop_event();
        if (kTrims && row.x == kWindowWaits) {
            take_window(row.z);
            give_back_window(row.z);
        } else {
            take_event(row);
        }
    } else {
        lane.phase = kPhaseBlock;
        lane.cursor = 0u;
    }
}

// The next lit corner of the fan, or none, with its shadow; looks one lit corner ahead, to tell when it is
// the last.
uint next_lit_corner() {
    uint corner = lane.corner_ahead;
    lane.known = lane.shadow_ahead;
    lane.corner_ahead = kNoHalfEdge;
    for (uint i = 0u; i < kCornersPerTrip && lane.cursor < lane.cursor_end &&
                      lane.corner_ahead == kNoHalfEdge;
         ++i) {
        uvec2 next = fan_corner(lane.cursor);
        ++lane.cursor;
        uint shadow = shadow_in(next.y);
        if (shadow != kNoShadow) {
            bool is_first = corner == kNoHalfEdge;
            lane.corner_ahead = is_first ? kNoHalfEdge : next.x;
            lane.shadow_ahead = shadow;
            lane.known = is_first ? shadow : lane.known;
            corner = is_first ? next.x : corner;
        }
    }
    return corner;
}

// Chooses the face of the next operation; false if there is none in this trip.
bool next_operation() {
    if (lane.phase == kPhaseCross) {
        bool same_way = (lane.mode == kModeSameWay) == ((edge.around & 1u) != 0u);
        lane.mode = same_way ? kModeSameWay : kModeOpposite;
        lane.half_edge = edge.around >> 1;
    }
    if (lane.phase == kPhasePop) {
        take_next();
    }
    if (lane.phase == kPhaseFan) {
        uint corner = next_lit_corner();
        if (corner == kNoHalfEdge) {
            lane.phase = lane.cursor == lane.cursor_end ? kPhasePop : kPhaseFan;
            return false;
        }
        lane.half_edge = next_in_face(corner);
    }
    if (lane.phase == kPhaseSource) {
        lane.half_edge = 3u * own_face + lane.cursor;
        ++lane.cursor;
    }
    return lane.phase == kPhaseSource || lane.phase == kPhaseCross || lane.phase == kPhaseFan;
}

// Sets what follows the operation just set up, once its candidates are scanned.
void follow_up() {
    if (lane.phase == kPhaseSource) {
        lane.phase = lane.cursor == 3u ? kPhasePop : kPhaseSource;
    } else if (lane.phase == kPhaseFan) {
        bool is_last = lane.corner_ahead == kNoHalfEdge && lane.cursor == lane.cursor_end;
        lane.phase = is_last ? kPhasePop : kPhaseFan;
    } else if (lane.phase == kPhaseCross) {
        lane.phase = enters_more() ? kPhaseCross : kPhasePop;
    }
}

void trip() {
    window_taken = false;
    bool due = !scanning() && next_operation();
    load_face();
    if (due && trimmed()) {
        lane.phase = kPhasePop;
        due = false;
    }
    if (due && !turns_back()) {
        float source_square = place_source();
        set_margin();
        spread(source_square);
        if (kScans && (lane.phase != kPhaseSource || lane.cursor == 1u)) {
            begin_scan(entry_x(), lane.mode == kModeInside ? lane.y : -lane.y);
        }
    }
    if (kScans) {
        scan_some();
    }
    if (due) {
        follow_up();
    }
}

bool running() { return lane.phase > kPhaseClear && lane.phase < kPhaseBlock && overflow == 0u; }

// Takes a slot if the lane has none, works on it, and hands it in if it is done.
void step() {
    if (lane.phase == kPhaseIdle && slots_left()) {
        take_slot();
    }
    if (lane.phase == kPhaseClear) {
        clear_table();
    }
    for (uint i = 0u; i < kTripsPerStep && running(); ++i) {
        trip();
        ++trips;
    }
    if (overflow == kOverflowEndless) {
        put_aside();
    }
    if (!kTrims && overflow == kOverflowTrims && push.large_groups > 0u) {
        leave_to_group();
    }
    if (lane.phase == kPhaseBlock) {
        block_conflicts();
    }
    if (lane.phase == kPhaseComplete) {
        hand_in_slot();
    }
}

void work_on(uint index) {
    load_lane(index);
    load_candidate(lane.slot);
    load_face();
    for (uint i = 0u; i < push.step_budget && overflow == 0u; ++i) {
        step();
        ++own_steps;
        if (lane.phase == kPhaseIdle && !slots_left()) {
            break;
        }
    }
    if (overflow != 0u) {
        atomicOr(control.overflow, overflow & ~kOverflowEndless);
    }
    save_lane();
}

// Maximum of trips of the lanes of each subgroup. Metal wants a size that no specialization
// changes.
shared uint max_trips[kMaxCountedSubgroups];

// The lanes of a subgroup go on together until the last has done its trips.
void count_trips() {
    uint invocation = gl_LocalInvocationID.x;
    uint subgroup = min(invocation / kCountedLanes, kMaxCountedSubgroups - 1u);
    if (invocation < kMaxCountedSubgroups) {
        max_trips[invocation] = 0u;
    }
    barrier();
    atomicMax(max_trips[subgroup], trips);
    GEODISK_ADD_WIDE(control.trips_low, control.trips_high, trips)
    barrier();
    uint most = max_trips[subgroup];
    GEODISK_ADD_WIDE(control.lane_trips_low, control.lane_trips_high, most)
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    keep_constants();
    trips = 0u;
    begin_disks();
    if (index < push.lanes && atomic_load(control.incomplete) > 0u &&
        atomic_load(control.overflow) == 0u) {
        work_on(index);
    }
    sum_disks();
    if (kCountedLanes > 0u) {
        count_trips();
    }
}
