// State of a lane that computes a disk: everything it keeps in its slice between dispatches, and where.
#ifndef GEODISK_LANE_GLSL
#define GEODISK_LANE_GLSL

layout(constant_id = kSpecTrims) const bool kTrims = false;

// The nearer child of a window is taken next and need not go through the pool: stores cost most of a
// trip on lavapipe. Not in kernels that are short of registers.
const bool kHolds = !kTrims && !kAdaptive;
const bool kRemembers = kTrims;

LaneRec lane;
uint overflow;     // kOverflow* bits
uint slice;        // first row of the lane in the pool
uint first_event;  // among the rows of the lane
uint first_vertex;
uint first_kept;
uint first_remembered;

// Returns the index in the pool of a row of this lane.
uint own_row(uint at) { return slice + at * kPoolBlock; }

// Member by member: for a struct that is assigned as a whole, glslang 12 loops forever when it looks for
// `precise`.
void load_lane(uint index) {
    slice = first_row(index);
    first_event = kLaneRows + kWindowRows * push.window_capacity;
    first_vertex = first_event + push.window_capacity;
    first_kept = first_vertex + push.table_capacity;
    first_remembered = first_kept + kTrimRows;
    overflow = 0u;
    uvec4 a = own_row_at(pool, own_row(0u));
    uvec4 b = own_row_at(pool, own_row(1u));
    uvec4 c = own_row_at(pool, own_row(2u));
    uvec4 d = own_row_at(pool, own_row(3u));
    uvec4 e = own_row_at(pool, own_row(4u));
    uvec4 f = own_row_at(pool, own_row(5u));
    uvec4 g = own_row_at(pool, own_row(6u));
    uvec4 h = own_row_at(pool, own_row(7u));
    uvec4 i = own_row_at(pool, own_row(8u));
    uvec4 j = own_row_at(pool, own_row(9u));
    uvec4 k = own_row_at(pool, own_row(10u));
    lane.slot = a.x, lane.phase = a.y, lane.idle_conflicts = a.z, lane.active_conflicts = a.w;
    lane.windows = b.x, lane.event_head = b.y, lane.event_tail = b.z, lane.generation = b.w;
    lane.half_edge = c.x, lane.mode = c.y;
    lane.x = uintBitsToFloat(c.z), lane.y = uintBitsToFloat(c.w);
    lane.b0 = uintBitsToFloat(d.x), lane.b1 = uintBitsToFloat(d.y);
    lane.sigma = uintBitsToFloat(d.z), lane.chain = d.w;
    lane.known = e.x, lane.cursor = e.y, lane.cursor_end = e.z, lane.corner_ahead = e.w;
    lane.scan_place = f.x, lane.scan_end = f.y, lane.scan_row = f.z, lane.scan_row_end = f.w;
    lane.scan_columns = g.x, lane.scan_stride = g.y, lane.tested = g.z, lane.pushed = g.w;
    lane.max_waiting = h.x, lane.longest_chain = h.y, lane.vertices = h.z, lane.remembered = h.w;
    lane.entry_low = int(i.x), lane.entry_high = int(i.y), lane.entry_turn = int(i.z);
    lane.shadow_ahead = i.w;
    lane.trims = j.x, lane.free_place = j.y;
    if (kHolds) {
        lane.held_known = j.z, lane.held_b1 = uintBitsToFloat(j.w);
        lane.held_around = k.x, lane.held_x = uintBitsToFloat(k.y);
        lane.held_y = uintBitsToFloat(k.z), lane.held_b0 = uintBitsToFloat(k.w);
    }
}

void save_lane() {
    pool[own_row(0u)] =
        uvec4(lane.slot, lane.phase, lane.idle_conflicts, lane.active_conflicts);
    pool[own_row(1u)] = uvec4(lane.windows, lane.event_head, lane.event_tail, lane.generation);
    pool[own_row(2u)] =
        uvec4(lane.half_edge, lane.mode, floatBitsToUint(lane.x), floatBitsToUint(lane.y));
    pool[own_row(3u)] = uvec4(floatBitsToUint(lane.b0), floatBitsToUint(lane.b1),
                              floatBitsToUint(lane.sigma), lane.chain);
    pool[own_row(4u)] = uvec4(lane.known, lane.cursor, lane.cursor_end, lane.corner_ahead);
    pool[own_row(5u)] = uvec4(lane.scan_place, lane.scan_end, lane.scan_row, lane.scan_row_end);
    pool[own_row(6u)] = uvec4(lane.scan_columns, lane.scan_stride, lane.tested, lane.pushed);
    pool[own_row(7u)] =
        uvec4(lane.max_waiting, lane.longest_chain, lane.vertices, lane.remembered);
    pool[own_row(8u)] =
        uvec4(lane.entry_low, lane.entry_high, lane.entry_turn, lane.shadow_ahead);
    pool[own_row(9u)] =
        uvec4(lane.trims, lane.free_place, lane.held_known, floatBitsToUint(lane.held_b1));
    pool[own_row(10u)] = uvec4(lane.held_around, floatBitsToUint(lane.held_x),
                               floatBitsToUint(lane.held_y), floatBitsToUint(lane.held_b0));
}

// Empties the vertices and windows of the lane, for the next disk of its table.
void begin_windows() {
    bool wrapped = lane.generation == kMaxGenerations;
    lane.generation = wrapped ? 1u : lane.generation + 1u;
    lane.phase = wrapped ? kPhaseClear : kPhaseSource;
    lane.windows = 0u;
    lane.held_around = kNoWindow;
    lane.free_place = kNoWindow;
    lane.event_head = 0u;
    lane.event_tail = 0u;
    lane.mode = kModeInside;
    lane.cursor = 0u;
    lane.scan_place = 0u;
    lane.scan_end = 0u;
    lane.scan_row = 0u;
    lane.scan_row_end = 0u;
    lane.vertices = 0u;
}

// Begins the disk of a slot.
void begin_disk(uint slot) {
    lane.slot = slot;
    lane.idle_conflicts = 0u;
    lane.active_conflicts = 0u;
    lane.tested = 0u;
    lane.pushed = 0u;
    lane.max_waiting = 0u;
    lane.longest_chain = 0u;
    lane.trims = 0u;
    begin_windows();
}

#endif
