// A work group that computes one disk together: its record, and the lists in its slice. With the capacity
// of windows as their length:
//   GroupRec
//   windows      two lists, kItemRows rows each, the first rows of all first
//   events       two lists, a row each: (vertex of the table, nearness, first corner, end of corners)
//   scans        two lists, a row each: (window, place, end, row of cells)
//   proposals    a row each: (window, and 1 for the end of its edge; vertex of the table, distance, crossing)
//   taken        a word each: the windows of this wave
//   remembered   two lists, a word each: what windows remember, see turns_back()
//   table        kGroupVertexRows rows per vertex
//   vertices     a word each: where they are in the table
// Rows of a window: (next half-edge around the edge, with its direction bit, x, y, b0), (b1, sigma, chain,
// known), as of a lane. A source inside a face has b1 = kInsideFace and its shadow in place of known,
// and that of the disk a chain of 0.
#ifndef GEODISK_GROUP_GLSL
#define GEODISK_GROUP_GLSL

LaneRec lane; // the window in flight of this invocation
uint overflow;
const bool kRemembers = true;

shared GroupRec group;
shared uint group_overflow;
shared bool group_works;

uint group_slice; // first row

float crossing_error() { return kCrossingError; }

const float kInsideFace = -1.0;
const uint kNoVertex = 0xffffffffu;
const uint kBendsThere = 0x80000000u; // with a vertex of the table: its fan is lit
const uint kScanIsDue = 0xffffffffu;  // as a row of cells
const uint kWholeRange = 0xffffffffu;

uint row_of_list(uint list, uint at) {
    return group_slice + kGroupRows + list * push.window_capacity + at;
}
uint item_row(uint turn, uint item, uint row) {
    return row_of_list(turn * kItemRows + row, item);
}
uint event_row(uint turn, uint event) { return row_of_list(2u * kItemRows + turn, event); }
uint scan_row(uint turn, uint scan) { return row_of_list(2u * kItemRows + 2u + turn, scan); }
uint proposal_row(uint proposal) { return row_of_list(2u * kItemRows + 4u, proposal); }
uint taken_word(uint number) { return 4u * row_of_list(2u * kItemRows + 5u, 0u) + number; }
uint remembered_word(uint turn, uint item) {
    return taken_word((turn + 1u) * push.window_capacity + item);
}
uint table_row(uint vertex) {
    return row_of_list(2u * kItemRows + 6u, 0u) + kGroupVertexRows * vertex;
}
uint vertex_word(uint number) { return 4u * table_row(push.table_capacity) + number; }

void write_word(uint word, uint value) { pool[word >> 2][word & 3u] = value; }
uint read_word(uint word) { return own_row_at(pool, word >> 2)[word & 3u]; }

// By the first invocation, as what follows.
void load_group() {
    uvec4 a = own_row_at(pool, group_slice);
    uvec4 b = own_row_at(pool, group_slice + 1u);
    uvec4 c = own_row_at(pool, group_slice + 2u);
    uvec4 d = own_row_at(pool, group_slice + 3u);
    uvec4 e = own_row_at(pool, group_slice + 4u);
    uvec4 f = own_row_at(pool, group_slice + 5u);
    uvec4 g = own_row_at(pool, group_slice + 6u);
    group.slot = a.x, group.phase = a.y, group.cursor = a.z;
    group.turn = a.w;
    group.items = b.x, group.next_items = b.y, group.events = b.z, group.next_events = b.w;
    group.scans = c.x, group.next_scans = c.y, group.scan_turn = c.z, group.proposals = c.w;
    group.end = uintBitsToFloat(d.x), group.step = uintBitsToFloat(d.y);
    group.nearest = d.z, group.waves = d.w;
    group.idle_conflicts = e.x, group.active_conflicts = e.y;
    group.conflicts = e.z, group.vertices = e.w;
    group.tested = f.x, group.pushed = f.y;
    group.max_waiting = f.z, group.longest_chain = f.w;
    group.taken = g.x, group.longest_before = g.y, group.lit_again = g.z;
}

void save_group() {
    pool[group_slice] = uvec4(group.slot, group.phase, group.cursor, group.turn);
    pool[group_slice + 1u] =
        uvec4(group.items, group.next_items, group.events, group.next_events);
    pool[group_slice + 2u] =
        uvec4(group.scans, group.next_scans, group.scan_turn, group.proposals);
    pool[group_slice + 3u] = uvec4(floatBitsToUint(group.end), floatBitsToUint(group.step),
                                   group.nearest, group.waves);
    pool[group_slice + 4u] = uvec4(group.idle_conflicts, group.active_conflicts, group.conflicts,
                                   group.vertices);
    pool[group_slice + 5u] =
        uvec4(group.tested, group.pushed, group.max_waiting, group.longest_chain);
    pool[group_slice + 6u] = uvec4(group.taken, group.longest_before, group.lit_again, 0u);
}

// Amounts that an invocation adds to the record at the end of a step.
uint own_tested;
uint own_pushed;
uint own_longest;
uint own_nearest;
uint own_lit_again;

void begin_step() {
    own_tested = 0u;
    own_pushed = 0u;
    own_longest = 0u;
    own_nearest = 0xffffffffu;
    own_lit_again = 0u;
}

void end_step() {
    if (own_tested != 0u) {
        atomicAdd(group.tested, own_tested);
    }
    if (own_pushed != 0u) {
        atomicAdd(group.pushed, own_pushed);
    }
    if (own_longest != 0u) {
        atomicMax(group.longest_chain, own_longest);
    }
    if (own_nearest != 0xffffffffu) {
        atomicMin(group.nearest, own_nearest);
    }
    if (own_lit_again != 0u) {
        atomicAdd(group.lit_again, own_lit_again);
    }
    if (overflow != 0u) {
        atomicOr(group_overflow, overflow);
    }
}

void push_item(float distance, uvec4 row0, uvec4 row1, uint remembered) {
    uint at = atomicAdd(group.next_items, 1u);
    if (at >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    uint list = group.turn ^ 1u;
    pool[item_row(list, at, 0u)] = row0;
    pool[item_row(list, at, 1u)] = row1;
    if (row1.z >= kFirstRemembered) {
        write_word(remembered_word(list, at), remembered);
    }
    own_nearest = min(own_nearest, floatBitsToUint(distance));
}

// Pushes a source inside the face of h, at its apex, which lights a shadow there.
void push_inside(uint h, float sigma, uint chain, uint shadow) {
    push_item(sigma, uvec4(h << 1, 0u, 0u, 0u),
              uvec4(floatBitsToUint(kInsideFace), floatBitsToUint(sigma), chain, shadow), kNoHalfEdge);
}

void push_event(float distance, uvec4 row) {
    uint at = atomicAdd(group.next_events, 1u);
    if (at >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    pool[event_row(group.turn ^ 1u, at)] = row;
    own_nearest = min(own_nearest, floatBitsToUint(distance));
}

void push_scan(uvec4 row) {
    uint at = atomicAdd(group.next_scans, 1u);
    if (at >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    pool[scan_row(group.scan_turn ^ 1u, at)] = row;
}

void push_proposal(uvec4 row) {
    uint at = atomicAdd(group.proposals, 1u);
    if (at >= push.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    pool[proposal_row(at)] = row;
}

void note_conflict(uint place, bool is_active, bool conflicts, float square) {
    ++own_tested;
    if (conflicts) {
        if (atomicAdd(group.conflicts, 1u) >= push.list_capacity) {
            overflow |= kOverflowConflicts;
            return;
        }
        uint at = is_active
                      ? active_entry(push.list_capacity, atomicAdd(group.active_conflicts, 1u))
                      : atomicAdd(group.idle_conflicts, 1u);
        write_word(4u * list_first + at, place);
    }
}

#endif
