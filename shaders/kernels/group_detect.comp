#version 450
#extension GL_GOOGLE_include_directive : require
// The geodesic disks of active candidates, as of detect.comp, each by a work group together, in waves. A
// wave takes all windows and events that are nearer than the nearest one and a step. Within a phase
// nothing is read that changes but by atomics, of which the order does not matter: so the result is the same
// for any number of lanes. kernels_ref/kernels/group_detect.hpp is the same in plain C++; read that first.
// reads: faces, fans, radii, cells, weights, orders   writes: pool, slots, control
// spec: local size, rounding, adaptive, many rows, avoids, classes

#define GEODISK_KEEPS_CONSTANTS
#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/rounding.glsl"
#include "../lib/weights.glsl"
#include "../lib/radii.glsl"
#include "../lib/half_edge.glsl"
#include "../lib/cells.glsl"

layout(local_size_x_id = 14) in; // kSpecGroupLanes

GEODISK_WORDS(kBindCells, cells);
GEODISK_WORDS(kBindWeights, weights);
GEODISK_WORDS(kBindOrders, orders);
GEODISK_GROUP_ROWS(kBindPool, kBindPoolTexels, pool);
GEODISK_CONTROL;

#include "../lib/lists.glsl"
#include "../lib/group.glsl"
#include "../lib/many_windows.glsl"
#include "../lib/windows.glsl"
#include "../lib/shadow.glsl"
#include "../lib/group_table.glsl"
#include "../lib/scan.glsl"
#include "../lib/source.glsl"
#include "../lib/complete.glsl"
#include "../lib/disk_totals.glsl"

// Writes a window of the first wave: the whole edge of the candidate's face.
void begin_item(uint corner) {
    pool[item_row(group.turn, corner, 0u)] = uvec4((3u * own_face + corner) << 1, 0u, 0u, 0u);
    pool[item_row(group.turn, corner, 1u)] = uvec4(floatBitsToUint(kInsideFace), 0u, 0u, 0u);
}

uvec4 row0; // of the window in flight
uvec4 row1;

// Takes a window of this wave, or one that waits, into flight.
void take_item(uint item) {
    row0 = own_row_at(pool, item_row(group.turn, item, 0u));
    row1 = own_row_at(pool, item_row(group.turn, item, 1u));
    lane.half_edge = row0.x >> 1;
    lane.x = uintBitsToFloat(row0.y);
    lane.y = uintBitsToFloat(row0.z);
    lane.b0 = uintBitsToFloat(row0.w);
    lane.b1 = uintBitsToFloat(row1.x);
    lane.sigma = uintBitsToFloat(row1.y);
    lane.chain = row1.z;
    lane.known = row1.w;
    lane.mode = lane.b1 == kInsideFace ? kModeInside
                : (row0.x & 1u) != 0u  ? kModeSameWay
                                       : kModeOpposite;
    lane.phase = lane.mode != kModeInside ? kPhaseCross
                 : lane.chain == 0u       ? kPhaseSource
                                          : kPhaseFan;
    margin = max(job.margin, error_of(group.longest_before));
    lane.remembered = kNoHalfEdge;
    if (lane.chain >= kFirstRemembered) {
        lane.remembered = read_word(remembered_word(group.turn, item));
    }
}

// Returns the distance of the window in flight, at the nearest point that it lights of its edge.
float distance_of_item() {
    precise float left_of = lane.b0 - lane.x;
    precise float right_of = lane.x - lane.b1;
    float aside = lane.x < lane.b0 ? left_of : (lane.x > lane.b1 ? right_of : 0.0);
    precise float distance = lane.sigma + root(squared(aside, lane.y));
    return lane.mode == kModeInside ? lane.sigma : distance;
}

// Lists a window if it is of this wave; else it waits for the next.
void sort_item(uint item) {
    take_item(item);
    float distance = distance_of_item();
    if (distance < group.end) {
        write_word(taken_word(atomicAdd(group.taken, 1u)), item);
    } else {
        push_item(distance, row0, row1, lane.remembered);
    }
}

// Returns true if the face has candidates that the window in flight may reach.
bool has_candidates() {
    bool single = single_cell(cell_word);
    uint cell = cell_word & kFirstCellMask;
    uint entries = kManyRows ? 1u : push.stages;
    return !single || word_at(cells, cell) < word_at(cells, cell + entries);
}

// Proposes the distances of the vertices where paths of a window of this wave end.
void propose_item(uint number) {
    uint item = read_word(taken_word(number));
    take_item(item);
    load_face();
    bool is_due = !turns_back();
    float source_square = place_source();
    // The first edge of the face scans for all three of the source.
    bool scans = lane.phase != kPhaseSource || lane.half_edge % 3u == 0u;
    if (is_due && scans && has_candidates()) {
        push_scan(uvec4(item, 0u, 0u, kScanIsDue));
    }
    bool inside = lane.mode == kModeInside;
    bool of_fan = lane.phase == kPhaseFan;
    Meeting m = meet_apex(entry_x(), entry_interval());
    precise float start_distance = lane.sigma + (of_fan ? left.len : root(source_square));
    precise float end_distance = lane.sigma + right.len;
    for (uint i = inside ? 0u : 2u; i < (inside ? 2u : 3u); ++i) {
        uint origin = i == 0u ? edge.origin : (i == 1u ? right.origin : left.origin);
        float distance = i == 0u ? start_distance : (i == 1u ? end_distance : m.distance);
        bool is_wanted = is_due && (i == 0u || (i == 1u ? of_fan : m.sees_apex));
        float crossing = inside ? (i == 0u ? right.len : 0.0) : m.crossing;
        propose(item << 1 | (i & 1u), origin, is_wanted ? distance : kFar, crossing);
    }
}

// Tests candidates under a window.
void scan_item(uint scan) {
    uvec4 row = own_row_at(pool, scan_row(group.scan_turn, scan));
    take_item(row.x);
    load_face();
    place_source();
    begin_scan(entry_x(), lane.mode == kModeInside ? lane.y : -lane.y);
    if (row.w != kScanIsDue) {
        lane.scan_place = row.y;
        lane.scan_end = row.z;
        lane.scan_row = row.w;
    }
    scan_some();
    if (scanning()) {
        push_scan(uvec4(row.x, lane.scan_place, lane.scan_end, lane.scan_row));
    }
}

void settle_proposal(uint proposal) {
    uvec4 row = own_row_at(pool, proposal_row(proposal));
    uint item = row.x >> 1;
    uint half_edge = own_row_at(pool, item_row(group.turn, item, 0u)).x >> 1;
    row1 = own_row_at(pool, item_row(group.turn, item, 1u));
    bool inside = uintBitsToFloat(row1.x) == kInsideFace;
    bool whole = inside && row1.z == 0u && uintBitsToFloat(row.z) <= kNearVertex;
    uint next = next_in_face(half_edge);
    uint corner = !inside ? next_in_face(next) : ((row.x & 1u) != 0u ? next : half_edge);
    // At the corners of its own face the direction of the candidate is left open.
    precise float way = uintBitsToFloat(row.z) - uintBitsToFloat(row1.y);
    uint chain = row1.z + 1u;
    uint blur = inside ? (row1.z == 0u ? kMaxBlur : 0u) : blur_of(error_of(chain), way);
    settle(row.y, row.z, whole ? kWholeWay : way_of(corner, inside), uintBitsToFloat(row.w), chain, blur);
}

// Looks up the distances of start, end and apex, those of a window's edge only if it does not carry them.
// Cuts the meeting at the way that other windows took to the apex.
vec3 look_up_distances(inout Meeting m) {
    bool inside = lane.mode == kModeInside;
    vec3 distances = vec3(known_ends(), kFar);
    for (uint i = inside ? 0u : 2u; i < (inside ? 2u : 3u); ++i) {
        uint origin = i == 0u ? edge.origin : (i == 1u ? right.origin : left.origin);
        uint at = find(origin & kVertexMask);
        bool found = at != kNoVertex;
        uvec4 row0 = own_row_at(pool, table_row(found ? at : 0u));
        uvec4 row1 = own_row_at(pool, table_row(found ? at : 0u) + 1u);
        float known = found ? distance_of(row0.y) : kFar;
        distances.x = i == 0u ? known : distances.x;
        distances.y = i == 1u ? known : distances.y;
        distances.z = i == 2u ? known : distances.z;
        if (i == 2u) {
            uint way = way_of(next_in_face(next_in_face(lane.half_edge)), false);
            bool same_angle = found && row1.x == way && row1.y == ~way;
            split_once(m, same_angle, known, from_ordered(~row1.z));
        }
    }
    return distances;
}

// Makes the windows of the next wave.
void spread_item(uint number) {
    uint item = read_word(taken_word(number));
    take_item(item);
    load_face();
    place_source();
    bool spreads = !turns_back();
    bool inside = lane.mode == kModeInside;
    float sx = entry_x();
    vec2 lit = entry_interval();
    Meeting m = meet_apex(sx, lit);
    vec3 distances = look_up_distances(m);
    Window first = kNoChild;
    Window second = kNoChild;
    for (uint i = 0u; i < (inside ? 1u : 2u); ++i) {
        first = second;
        second = kNoChild;
        if (spreads && (inside || (i == 0u ? m.to_left : m.to_right))) {
            second = leave(i == 0u, m, sx, lit, distances);
        }
    }
    bool has_first = first.distance >= 0.0;
    bool has_second = second.distance >= 0.0;
    uint children = (has_first ? 1u : 0u) + (has_second ? 1u : 0u);
    own_pushed += children;
    own_longest = max(own_longest, children > 0u ? lane.chain + 1u : 0u);
    // And itself, to enter another face.
    bool enters = lane.phase == kPhaseCross && enters_more();
    uint pushed = children + (enters ? 1u : 0u);
    if (enters) {
        bool same_way = (lane.mode == kModeSameWay) == ((edge.around & 1u) != 0u);
        row0.x = (edge.around & ~1u) | (same_way ? 1u : 0u);
    }
    uint remembers = remember();
    for (uint i = 0u; i < pushed; ++i) {
        Window next = second;
        if (i == 0u && has_first) {
            next = first;
        }
        if (i >= children) {
            next = Window(distance_of_item(), row0, row1);
        }
        push_item(next.distance, next.row0, next.row1, i < children ? remembers : lane.remembered);
    }
}

// Returns how the shortest path to a vertex came in through its corner, by where it crossed the edge opposite
// to that; `paths` is the second row of the vertex.
uint arrival_at(uvec4 paths) {
    if (paths.x != ~paths.y || ~paths.y == kWholeWay) {
        return kMaxBlur;
    }
    lane.half_edge = next_in_face(corner_of(paths.x));
    load_face();
    float crossing = from_ordered(~paths.z);
    precise float along = apex.x * apex.x + apex.y * apex.y - apex.x * crossing;
    precise float across = apex.y * crossing;
    // Rounding of the crossing turns the direction as well.
    precise float aside = apex.x - crossing;
    precise float error = job.slack * kCrossingPart;
    uint blur = max(paths.w & kMaxBlur, blur_of(error, root(squared(aside, apex.y))));
    return arrival_from(along, across, blur);
}

// Lights the fan of a vertex, unless it was reached sooner by now. A wide fan is halved, for the next wave.
void light_fan(uint event) {
    uvec4 row = own_row_at(pool, event_row(group.turn, event));
    uvec4 vertex = own_row_at(pool, table_row(row.x));
    uvec4 paths = own_row_at(pool, table_row(row.x) + 1u);
    bool is_current = vertex.y == row.y;
    float distance = distance_of(row.y);
    uvec4 fan = row_at(fans, vertex.x - 1u);
    uint first = row.z;
    uint end = min(row.w, fan.y);
    bool waits = !(distance < group.end);
    bool is_wide = !waits && end - first > kCornersPerEvent;
    if (is_current && (waits || is_wide)) {
        uint middle = is_wide ? first + (end - first) / 2u : row.w;
        for (uint i = 0u; i < (is_wide ? 2u : 1u); ++i) {
            push_event(distance, uvec4(row.xy, i == 0u ? first : middle, i == 0u ? middle : end));
        }
        return;
    }
    enter_fan(fan.z, fan.w, corner_of(~paths.y), arrival_at(paths));
    for (uint i = first; i < (is_current ? end : first); ++i) {
        uvec2 corner = fan_corner(fan.x + i);
        uint shadow = shadow_in(corner.y);
        if (shadow != kNoShadow) {
            push_inside(next_in_face(corner.x), distance, paths.w >> kBlurBits, shadow);
        }
    }
}

void block_conflict(uint number) {
    uint at = active_entry(push.list_capacity, number);
    block(sample_of(group.slot), own_row_at(pool, list_first + (at >> 2))[at & 3u]);
}

void clear_vertex(uint number) {
    uint at = table_row(read_word(vertex_word(number)));
    pool[at] = uvec4(0u);
    pool[at + 1u] = uvec4(0u);
}

// Returns how many there are of what a phase goes through.
uint end_of(uint phase) {
    return phase == kGroupPropose || phase == kGroupSpread ? group.taken
           : phase == kGroupScan                           ? group.scans
           : phase == kGroupSettle                         ? group.proposals
           : phase == kGroupLight                          ? group.events
           : phase == kGroupBlock                          ? group.active_conflicts
           : phase == kGroupClear                          ? group.vertices
                                                           : group.items;
}

// The part of a phase that is done now: what this invocation does first, and the end. It is empty in other
// phases. An `if` would not do: lavapipe executes what it encloses, but the body of a loop only once.
struct Part {
    uint first;
    uint end;
};

Part part_of_phase(uint phase) {
    uint end = min(end_of(phase), group.cursor + kItemsPerStep * gl_WorkGroupSize.x);
    return Part(group.cursor + gl_LocalInvocationID.x, group.phase == phase ? end : 0u);
}

// The first invocation alone calls the functions below, between barriers.

// Begins the disk of a slot: with windows through the three edges of the face.
void begin_disk(uint slot) {
    uint face = slots[slot].face;
    uvec4 lengths = load_lengths(face);
    precise float around = uintBitsToFloat(lengths.x) + uintBitsToFloat(lengths.y) +
                           uintBitsToFloat(lengths.z);
    precise float third = around * 0.33333334 * scale_of(uintBitsToFloat(slots[slot].turn));
    float step = max(third, job.slack); // Waves on a face of about no size would not end.
    group.slot = slot;
    group.phase = kGroupSource;
    group.items = 3u;
    group.taken = 0u;
    group.events = 0u;
    group.step = step;
    group.end = step;
    group.nearest = 0xffffffffu;
    group.waves = 0u;
    group.lit_again = 0u;
    group.idle_conflicts = 0u;
    group.active_conflicts = 0u;
    group.conflicts = 0u;
    group.vertices = 0u;
    group.tested = 0u;
    group.pushed = 0u;
    group.max_waiting = 0u;
    group.longest_chain = 0u;
    group.longest_before = 0u;
}

void begin_unless_void(uint slot) {
    if (is_void(slot)) {
        complete_one();
    } else {
        begin_disk(slot);
    }
}

// Takes one of the disks that lanes have left. If another work group takes the same one, tries
// again in the next step.
void take_large() {
    uint next = atomic_load(control.next_large);
    if (next >= control.large) {
        group_works = false;
    } else if (atomicCompSwap(control.next_large, next, next + 1u) == next) {
        begin_unless_void(slots[next].scan_place);
    }
}

void take_slot() {
    if (push.large_groups > 0u) {
        take_large();
        return;
    }
    uint next = atomicAdd(control.next_slot, 1u);
    if (next >= control.slots_used) {
        group_works = false;
    } else {
        begin_unless_void(next);
    }
}

void end_wave() {
    ++group.waves;
    group.max_waiting = max(group.max_waiting, group.next_items);
    group.turn ^= 1u;
    group.items = group.next_items;
    group.events = group.next_events;
    group.next_items = 0u;
    group.next_events = 0u;
    group.taken = 0u;
    group.proposals = 0u;
    group.longest_before = group.longest_chain;
    float doubled = group.step * 2.0;
    float step = group.waves % kWavesPerStep == 0u ? doubled : group.step;
    // Vertices that are lit again and again waste windows: smaller waves have them in order.
    if (group.lit_again > kLitAgain + group.vertices / 4u) {
        step *= 0.5;
        group.lit_again = 0u;
    }
    precise float end = uintBitsToFloat(group.nearest) + step;
    group.step = step;
    group.end = end;
    group.nearest = 0xffffffffu;
    if (makes_many(kUntrimmedInGroups, group.vertices, group.longest_chain, group.pushed)) {
        group_overflow |= kOverflowTrims; // Lanes do that, each with memory for it.
    }
    group.phase = group.items + group.events > 0u ? kGroupSort : kGroupBlock;
}

void hand_in_slot() {
    slots[group.slot].idle_conflicts = group.idle_conflicts;
    slots[group.slot].active_conflicts = group.active_conflicts;
    slots[group.slot].longest_chain = group.longest_chain;
    slots[group.slot].phase = kSlotListed;
    add_disk(group.pushed, group.tested, group.max_waiting, group.vertices, group.conflicts);
    complete_one();
    group.phase = kGroupIdle;
}

// The overflow as the host is told it. Lanes judge a disk that does not end.
uint told_overflow() {
    uint by_lanes = (group_overflow & kOverflowEndless) != 0u ? kOverflowTrims : 0u;
    uint of_slice = group_overflow & (kOverflowWindows | kOverflowVertices);
    uint others = group_overflow & ~(of_slice | kOverflowEndless);
    return others | by_lanes | of_slice << (push.large_groups > 0u ? kOverflowLargeShift : 0u);
}

// Goes on to another disk, or wave.
void go_on() {
    uint phase = group.phase;
    if (phase == kGroupIdle) {
        take_slot();
    } else if (phase == kGroupComplete) {
        hand_in_slot();
    } else if (phase == kGroupNextWave) {
        end_wave();
    }
}

// The phase that follows a phase of a wave.
uint phase_after(uint phase) {
    if (phase == kGroupPropose || phase == kGroupScan) {
        return group.next_scans > 0u ? kGroupScan : kGroupSettle;
    }
    return phase + 1u;
}

// Lets all invocations see what others have written, and goes on once what the phase goes through is done.
void meet_after(uint phase) {
    memoryBarrier();
    barrier();
    if (gl_LocalInvocationID.x == 0u && group.phase == phase) {
        uint cursor = group.cursor + kItemsPerStep * gl_WorkGroupSize.x;
        bool is_done = cursor >= end_of(phase);
        group.cursor = is_done ? 0u : cursor;
        if (is_done) {
            group.phase = phase_after(phase);
            if (phase == kGroupPropose || phase == kGroupScan) {
                group.scans = group.next_scans;
                group.next_scans = 0u;
                group.scan_turn ^= 1u;
            }
        }
    }
    memoryBarrier();
    barrier();
}

// Those of the last phases, and to the next wave or disk.
void meet_at_end() {
    end_step();
    memoryBarrier();
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        go_on();
        group_works = group_works && group_overflow == 0u;
    }
    memoryBarrier();
    barrier();
    begin_step();
}

void main() {
    uint index = gl_WorkGroupID.x;
    bool is_first = gl_LocalInvocationID.x == 0u;
    keep_constants();
    begin_disks();
    overflow = 0u;
    begin_step();
    if (is_first) {
        group_overflow = 0u;
        group_works = index < push.lanes && atomic_load(control.incomplete) > 0u &&
                      atomic_load(control.overflow) == 0u;
    }
    group_slice = push.first_slice_row + index * push.lane_rows;
    if (is_first) {
        load_group();
    }
    memoryBarrier();
    barrier();
    if (group_works && group.phase != kGroupIdle) {
        load_candidate(group.slot);
    }
    bool works = group_works;
    uint steps = 0u;
    while (works && steps < push.step_budget) {
        ++steps;
        Part part = part_of_phase(kGroupSource);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            begin_item(at);
        }
        meet_after(kGroupSource);
        part = part_of_phase(kGroupSort);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            sort_item(at);
        }
        meet_after(kGroupSort);
        part = part_of_phase(kGroupPropose);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            propose_item(at);
        }
        meet_after(kGroupPropose);
        part = part_of_phase(kGroupScan);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            scan_item(at);
        }
        meet_after(kGroupScan);
        part = part_of_phase(kGroupSettle);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            settle_proposal(at);
        }
        meet_after(kGroupSettle);
        part = part_of_phase(kGroupSpread);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            spread_item(at);
        }
        meet_after(kGroupSpread);
        part = part_of_phase(kGroupLight);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            light_fan(at);
        }
        meet_after(kGroupLight);
        part = part_of_phase(kGroupBlock);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            block_conflict(at);
        }
        meet_after(kGroupBlock);
        part = part_of_phase(kGroupClear);
        for (uint at = part.first; at < part.end; at += gl_WorkGroupSize.x) {
            clear_vertex(at);
        }
        meet_after(kGroupClear);
        bool was_idle = group.phase == kGroupIdle;
        meet_at_end();
        if (was_idle && group.phase != kGroupIdle) {
            load_candidate(group.slot);
        }
        works = group_works;
    }
    if (is_first && index < push.lanes) {
        own_steps = kGroupStepCost * steps;
        if (group_overflow != 0u) {
            atomicOr(control.overflow, told_overflow());
        }
        save_group();
    }
    sum_disks();
}
