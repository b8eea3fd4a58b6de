// The candidates of a face that the operation in flight can reach: cells are visited row by row, some
// candidates per trip of the main loop, so that a long list never outgrows the trip budget.
#ifndef GEODISK_SCAN_GLSL
#define GEODISK_SCAN_GLSL

uint scan_place;    // next candidate
uint scan_end;
uint scan_row;      // next row of cells, counted from the face's first cell
uint scan_row_end;
uint scan_column;   // cells of a row that can be reached: first, and how many
uint scan_columns;
uint tested;
uint conflicts;     // listed so far
uint list_first;    // row of this slot's list
uint own_rank;

const uint kScanPerTrip = 64u;

bool scanning() { return scan_place < scan_end || scan_row < scan_row_end; }

// A point given in the frame of h, in the frame of `base`, another half-edge of the face.
vec2 in_grid_frame(uint h, uint base, Edge base_edge, float px, float py) {
    if (h == base) {
        return vec2(px, py);
    }
    if (h == next_in_face(base)) {
        Turn turn = load_turn(h);
        precise float gx = base_edge.len - px * turn.cosine - py * turn.sine;
        precise float gy = px * turn.sine - py * turn.cosine;
        return vec2(gx, gy);
    }
    Turn turn = load_turn(base);
    precise float gx = base_edge.apex_x - px * turn.cosine + py * turn.sine;
    precise float gy = base_edge.apex_y - px * turn.sine - py * turn.cosine;
    return vec2(gx, gy);
}

// Sets out the cells of half_edge's face within reach of the source at (sx, sy) in its frame.
void begin_scan(float sx, float sy) {
    uint face = half_edge / 3u;
    uint word = cells[face];
    uint first = word & kFirstCellMask;
    scan_row = 0u;
    scan_row_end = 0u;
    if (single_cell(word)) {
        scan_place = cells[push.faces + first];
        scan_end = cells[push.faces + first + 1u];
        return;
    }
    Edge base;
    Grid grid = face_grid(face, word, base);
    vec2 at = in_grid_frame(half_edge, grid.base, base, sx, sy);
    precise float reach = (push.limit - sigma) + kCellPadding * (base.len + 1.0);
    precise float low_x = at.x - reach;
    precise float high_x = at.x + reach;
    precise float low_y = at.y - reach;
    precise float high_y = at.y + reach;
    scan_column = cell_at(low_x, grid.columns);
    scan_columns = cell_at(high_x, grid.columns) - scan_column + 1u;
    uint row0 = cell_at(low_y, grid.rows);
    uint row1 = cell_at(high_y, grid.rows);
    // Rows are kept as cell numbers with the grid's width between them.
    scan_row = row0;
    scan_row_end = row1 + 1u;
    scan_place = 0u;
    scan_end = 0u;
}

void next_row() {
    uint word = cells[half_edge / 3u];
    Edge base;
    Grid grid = face_grid(half_edge / 3u, word, base);
    uint start = push.faces + grid.first + scan_row * grid.columns + scan_column;
    scan_place = cells[start];
    scan_end = cells[start + scan_columns];
    ++scan_row;
}

void list_conflict(uint place, uint state) {
    if (conflicts >= push.list_capacity) {
        overflow |= kOverflowConflicts;
        return;
    }
    pool[list_first + (conflicts >> 2)][conflicts & 3u] = place;
    ++conflicts;
    if ((state & kStateMask) == kActive) {
        atomicAdd(blockers[state >> kStateSlotShift], 1u);
    }
}

// Tests a few candidates against the operation in flight.
void scan_some() {
    bool inside = mode == kModeInside;
    float sx = entry_x(edge.len);
    float sy = inside ? y : -y;
    vec2 lit = entry_interval(edge.len);
    precise float low = (lit.x - push.slack) - sx;
    precise float high = (lit.y + push.slack) - sx;
    precise float rest = push.limit - sigma;
    precise float rest2 = rest * rest;
    for (uint i = 0u; i < kScanPerTrip; ++i) {
        ++trips;
        if (scan_place >= scan_end) {
            if (scan_row >= scan_row_end) {
                break;
            }
            next_row();
            continue;
        }
        uint place = scan_place;
        ++scan_place;
        uint state = states[place];
        if ((state & kStateMask) > kActive) {
            continue;
        }
        uvec4 point = points[place];
        if (point.z <= own_rank) {
            continue;
        }
        ++tested;
        vec2 q = position_in(half_edge, edge, uintBitsToFloat(point.x), uintBitsToFloat(point.y));
        precise float dx = q.x - sx;
        precise float dy = q.y - sy;
        float distance2 = squared(dx, dy);
        if (distance2 < rest2) {
            precise float at = dx * y;
            precise float from = low * dy;
            precise float to = high * dy;
            if (inside || (at >= from && at <= to)) {
                list_conflict(place, state);
            }
        }
    }
}

#endif
