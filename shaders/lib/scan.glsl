// Tests the candidates of a face that the operation in flight can reach. Cells are visited row by row,
// some candidates per trip of the main loop, so that a long list never exceeds the bound on iterations.
// The kernel says what becomes of a candidate: note_conflict(place, is_active, conflicts, square), with the
// squared distance from the source of the operation.
#ifndef GEODISK_SCAN_GLSL
#define GEODISK_SCAN_GLSL

#include "job.glsl"
#include "many_rows.glsl"
#include "strip.glsl"

#ifndef GEODISK_REACH
uint weight_word(uint at) { return word_at(weights, at); }
#endif

bool scanning() { return lane.scan_place < lane.scan_end || lane.scan_row != lane.scan_row_end; }

// Converts a point from the frame of half_edge to that of another half-edge of the face.
vec2 in_grid_frame(bool to_left, bool to_right, float px, float py) {
    precise float left_x = left.len - px * edge.cosine - py * edge.sine;
    precise float left_y = px * edge.sine - py * edge.cosine;
    vec2 right_apex = apex_of(right, edge);
    precise float right_x = right_apex.x - px * right.cosine + py * right.sine;
    precise float right_y = right_apex.y - px * right.sine - py * right.cosine;
    return to_left ? vec2(left_x, left_y) : (to_right ? vec2(right_x, right_y) : vec2(px, py));
}

// Finds the cells of the face within reach of the source at (sx, sy).
void begin_scan(float sx, float sy) {
    uint corner = lane.half_edge % 3u;
    uint base = grid_corner(cell_word);
    bool to_left = base == previous_corner(corner);
    bool to_right = base == next_corner(corner);
    float len = to_left ? left.len : (to_right ? right.len : edge.len);
    float height = to_left ? apex_of(left, right).y : (to_right ? apex_of(right, edge).y : apex.y);
    Grid grid = face_grid(cell_word, len, height, scaled_cells_per_unit());
    vec2 at = in_grid_frame(to_left, to_right, sx, sy);
    precise float rest = reach_inside() - lane.sigma;
    precise float range = rest + kCellPadding * (len + 1.0);
    precise float low_x = at.x - range;
    precise float high_x = at.x + range;
    precise float low_y = at.y - range;
    precise float high_y = at.y + range;
    uint column = cell_at(low_x, grid.columns, grid.per_unit);
    uint row0 = cell_at(low_y, grid.rows, grid.per_unit);
    uint row1 = cell_at(high_y, grid.rows, grid.per_unit);
    // If all faces have one cell, each has an entry per stage.
    uint entries = kManyRows ? 1u : push.stages;
    lane.scan_columns = (cell_at(high_x, grid.columns, grid.per_unit) - column + 1u) * entries;
    lane.scan_stride = grid.columns * entries;
    lane.scan_row = grid.first + row0 * grid.columns + column;
    lane.scan_row_end = lane.scan_row + (row1 - row0 + 1u) * lane.scan_stride;
    lane.scan_place = 0u;
    lane.scan_end = 0u;
    if (kAdaptive && rest <= 0.0) {
        lane.scan_row = lane.scan_row_end; // The disk does not reach the face.
    }
}

// Returns the squared distance from the source of the operation below which a candidate conflicts whose
// distance from the candidate of the disk must be below `limit`.
float conflict_square(float limit) {
    precise float rest = limit - lane.sigma;
    precise float square = rest * rest;
    return rest > 0.0 ? square : 0.0;
}

// Candidates of a row of cells: `first` up to, not including, `end`.
struct Row {
    uint first;
    uint end;
};

const Strip kNoStrip = Strip(0u, 0u, 0u);

// Returns the row this many after the next, or only the rest of a row that was too long.
Row load_row(uint number) {
    if (!kManyRows && number > 0u) {
        return Row(0u, 0u);
    }
    bool resumes = lane.scan_place < lane.scan_end;
    uint ahead = number * lane.scan_stride;
    bool is_row = !resumes && ahead < lane.scan_row_end - lane.scan_row;
    uint cell = is_row ? lane.scan_row + ahead : 0u;
    uint first = word_at(cells, cell);
    uint end = word_at(cells, cell + (is_row ? lane.scan_columns : 0u));
    bool is_rest = resumes && number == 0u;
    return Row(is_rest ? lane.scan_place : first, is_rest ? lane.scan_end : end);
}

Strip strip_of(uint number, Row row) {
    return !kManyRows && number > 0u ? kNoStrip : load_strip(row.first, row.end);
}

// Reduces the strip to what is tested in this trip: all of it, or nothing once a strip is too much.
void take_strip(Row row, inout Strip strip, inout uint room, inout bool is_full) {
    uint count = uint(bitCount(strip.undecided));
    is_full = is_full || count > room || !scanning();
    if (is_full) {
        strip.undecided = 0u;
        return;
    }
    bool resumes = lane.scan_place < lane.scan_end;
    lane.scan_row += resumes ? 0u : lane.scan_stride;
    is_full = resumes || row.end > row.first + 32u;
    lane.scan_place = min(row.first + 32u, row.end);
    lane.scan_end = row.end;
    room -= count;
}

// Returns the first of two strips that is not empty.
Strip first_of(Strip a, Strip b) {
    if (a.undecided != 0u) {
        return a;
    }
    return b;
}

// Tests candidates against the operation in flight, at most as many as a trip allows. They are probably
// not in the caches, so all rows of a trip are fetched before anything depends on them.
void scan_some() {
    bool inside = lane.mode == kModeInside;
    uint corner = lane.half_edge % 3u;
    float sx = entry_x();
    float sy = inside ? lane.y : -lane.y;
    vec2 lit = entry_interval();
    precise float low = (lit.x - job.slack) - sx;
    precise float high = (lit.y + job.slack) - sx;
    precise float rest = path_limit() - lane.sigma;
    precise float rest2 = rest * rest;
    Row row0 = load_row(0u);
    Row row1 = load_row(1u);
    Row row2 = load_row(2u);
    Row row3 = load_row(3u);
    Strip strip0 = strip_of(0u, row0);
    Strip strip1 = strip_of(1u, row1);
    Strip strip2 = strip_of(2u, row2);
    Strip strip3 = strip_of(3u, row3);
    uint room = kScanPerTrip;
    bool is_full = false;
    take_strip(row0, strip0, room, is_full);
    take_strip(row1, strip1, room, is_full);
    take_strip(row2, strip2, room, is_full);
    take_strip(row3, strip3, room, is_full);
    // A single loop, so that lanes wait for each other only once.
    for (uint k = room; k < kScanPerTrip; ++k) {
        Strip strip = first_of(strip0, first_of(strip1, first_of(strip2, strip3)));
        uint rest = strip.undecided & (strip.undecided - 1u);
        if (strip0.undecided != 0u) {
            strip0.undecided = rest;
        } else if (strip1.undecided != 0u) {
            strip1.undecided = rest;
        } else if (strip2.undecided != 0u) {
            strip2.undecided = rest;
        } else {
            strip3.undecided = rest;
        }
        uint bit = uint(findLSB(strip.undecided));
        uint place = strip.first + bit;
        if (place == own_place) {
            continue;
        }
        ++lane.tested;
        uint word = weight_word(2u * place);
        float weight1 = weight_of(weight_in(word));
        float weight2 = weight_of(weight_word(2u * place + 1u));
        vec2 q = position_in(corner, edge.len, apex, weight1, weight2);
        precise float dx = q.x - sx;
        precise float dy = q.y - sy;
        precise float at = dx * lane.y;
        precise float from = low * dy;
        precise float to = high * dy;
        float limit2 = kAdaptive ? conflict_square(limit_with(radius_at(radii, weight1, weight2)))
                       : kClasses && !keeps_out() ? conflict_square(limit_for(class_in(word)))
                       : keeps_out_class(class_in(word)) ? rest2
                                                         : 0.0;
        float square = squared(dx, dy);
        bool conflicts = square < limit2 && (inside || (at >= from && at <= to));
        note_conflict(place, is_active(strip, bit), conflicts, square);
    }
}

#endif
