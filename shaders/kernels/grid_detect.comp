#version 450
#extension GL_GOOGLE_include_directive : require
// Computes the disk of every active candidate by a distance through space, and lists the idle and active
// candidates in it (paper DetectCollision, section 5.9). One invocation per slot; resumable. It visits
// the cells of the grid within reach of the disk, one row along the first axis at a time, in trips of
// bounded length, push.step_budget of them per dispatch.
// reads: axes, cells, points, orders   writes: pool, slots, control
// spec: local size, rounding, pool block, dimension, curved

#define GEODISK_KEEPS_CONSTANTS
#include "../lib/prelude.glsl"
#include "../lib/job.glsl"
#include "../lib/tolerances.glsl"
#include "../lib/curve.glsl"
#include "../lib/grid.glsl"
#include "../lib/point_words.glsl"

layout(local_size_x_id = 4) in; // kSpecSlotLocalSize
// Lengths of curves instead of straight distances, in three dimensions.
layout(constant_id = kSpecCurved) const bool kCurved = false;

GEODISK_WORDS(kBindCells, cells);
GEODISK_WORDS(kBindPoints, points);
GEODISK_WORDS(kBindOrders, orders);
GEODISK_BUFFER(kBindPool, , uvec4, pool);
GEODISK_CONTROL;

// Copy in registers: reading push constants in a branch is a gather on lavapipe.
Push P;

uint overflow; // kOverflow* bits

#include "../lib/slice.glsl"
#include "../lib/list.glsl"
#include "../lib/strip.glsl"
#include "../lib/complete.glsl"
#include "../lib/disk_totals.glsl"

Axis grid[kMaxAxes];
uint own[kMaxAxes];       // coordinates
uint own_cell[kMaxAxes];
float own_inside[kMaxAxes]; // the cell, as part of its width, rounded down
vec3 own_normal;
uint own_place;
uint idle_conflicts;      // listed so far
uint active_conflicts;
uint turn;
uint scan_place;           // next candidate
uint scan_end;
uint tested;
uint rows_visited;

vec3 normal_at(PointWords words) {
    uint first = words.first + 3u * words.stride;
    return uintBitsToFloat(uvec3(word_at(points, first), word_at(points, first + words.stride),
                                 word_at(points, first + 2u * words.stride)));
}

void load_own(uint slot) {
    PointWords words = own_place == kNoPlace ? words_of_settled(slot, kCurved ? 6u : kDimension)
                                             : PointWords(own_place, job.capacity);
    for (uint i = 0u; i < kDimension; ++i) {
        grid[i] = load_axis(i);
        own[i] = word_at(points, words.first + i * words.stride);
        uint inside;
        own_cell[i] = cell_on(grid[i], own[i], inside);
        precise float part = float(inside >> 8) * 5.9604645e-8;
        own_inside[i] = part;
    }
    own_normal = kCurved ? normal_at(words) : vec3(0.0);
}

// Returns true if the axis has so few cells that all are visited, each once, from the first on.
bool takes_all(Axis axis) { return axis.is_periodic && axis.cells < kGridDigits; }

// Returns the distance to cells along an axis, slightly less because of rounding; kFar if there are
// none.
float gap_to(uint i, uint digit) {
    int offset = int(digit) - int(kGridReach);
    int cell = int(own_cell[i]) + offset;
    bool is_there =
        takes_all(grid[i]) ? digit < grid[i].cells
                           : grid[i].is_periodic || (cell >= 0 && cell < int(grid[i].cells));
    precise float after = float(offset) - own_inside[i];
    precise float before = float(-offset - 1) + own_inside[i];
    precise float gap = (offset > 0 ? after : before) * grid[i].width - kCellPadding;
    bool is_near = offset == 0 || takes_all(grid[i]) || gap < 0.0;
    return is_there ? (is_near ? 0.0 : gap) : kFar;
}

uint cell_at(uint i, uint digit) {
    int count = int(grid[i].cells);
    int cell = int(own_cell[i]) + int(digit) - int(kGridReach);
    cell += cell < 0 ? count : (cell >= count ? -count : 0);
    return takes_all(grid[i]) ? digit : uint(cell);
}

float plus_square(float sum, float x) {
    precise float more = sum + x * x;
    return more;
}

// Returns the turn after all that share its digits from `level` on.
uint turn_after(uint at, uint level) {
    uint next = ((at >> (kDigitBits * level)) + 1u) << (kDigitBits * level);
    for (uint i = level; i < kDimension; ++i) {
        uint shift = kDigitBits * i;
        bool carries = ((next >> shift) & kDigitMask) == kGridDigits;
        next += carries ? (kDigitMask + 1u - kGridDigits) << shift : 0u;
    }
    return next;
}

bool turns_left() { return turn >> (kDigitBits * kDimension) == 0u; }

// Finds the next cells of a row within reach, or skips cells that are not.
void next_cells() {
    float sum = 0.0;
    uint head = 0u;
    uint beyond = 0u; // the slowest axis along which the cells are out of reach
    for (uint k = kDimension - 1u; k > 0u; --k) {
        uint digit = (turn >> (kDigitBits * k)) & kDigitMask;
        sum = plus_square(sum, gap_to(k, digit));
        beyond = beyond == 0u && sum >= job.limit ? k : beyond;
        head += cell_at(k, digit) * grid[k].stride;
    }
    uint first = kGridDigits;
    uint last = 0u;
    for (uint digit = 0u; digit < kGridDigits; ++digit) {
        bool is_due = digit >= (turn & kDigitMask) && plus_square(sum, gap_to(0u, digit)) < job.limit;
        first = is_due ? min(first, digit) : first;
        last = is_due ? digit : last;
    }
    if (beyond != 0u || first > last) {
        turn = turn_after(turn, max(beyond, 1u));
        return;
    }
    uint cell = cell_at(0u, first);
    head = head_in_table(head + cell);
    // Neither wraps around the box nor around the table.
    uint count = min(last - first + 1u, min(grid[0].cells - cell, job.cells - head));
    scan_place = word_at(cells, head);
    scan_end = word_at(cells, head + count);
    first += count;
    turn = first > last ? turn_after(turn, 1u) : ((turn & ~kDigitMask) | first);
    ++rows_visited;
}

// Converts steps of a coordinate to minimum distances. Halves convert exactly.
float along_axis(uint i, uint steps) {
    precise float whole = float(steps >> 16) * 65536.0 + float(steps & 0xffffu);
    precise float along = whole * grid[i].unit;
    return along;
}

// Returns the squared distance to the candidate at this place.
float square_to(uint place) {
    float sum = 0.0;
    for (uint i = 0u; i < kDimension; ++i) {
        uint other = word_at(points, i * job.capacity + place);
        uint ahead = other - own[i];
        uint back = own[i] - other;
        uint steps = grid[i].is_periodic ? min(ahead, back) : (other < own[i] ? back : ahead);
        sum = plus_square(sum, along_axis(i, steps));
    }
    return sum;
}

// Returns the vector to the candidate at this place.
vec3 way_to(uint place) {
    vec3 way = vec3(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        uint other = word_at(points, i * job.capacity + place);
        float along = along_axis(i, other < own[i] ? own[i] - other : other - own[i]);
        way[i] = other < own[i] ? -along : along;
    }
    return way;
}

bool conflicts_with(uint place) {
    float square = square_to(place);
    if (!kCurved) {
        return square < job.limit;
    }
    // No curve is shorter than the straight line.
    return square < job.limit &&
           is_short_curve(way_to(place), square, own_normal,
                          normal_at(PointWords(place, job.capacity)), job.limit);
}

void trip() {
    if (scan_place >= scan_end) {
        next_cells();
    }
    uint end = min(scan_place + kScanPerGridTrip, scan_end);
    Strip strip = load_strip(scan_place, end);
    scan_place = end;
    while (strip.undecided != 0u) {
        uint bit = uint(findLSB(strip.undecided));
        uint place = strip.first + bit;
        strip.undecided &= strip.undecided - 1u;
        if (place == own_place) {
            continue;
        }
        ++tested;
        list_conflict(idle_conflicts, active_conflicts, place, is_active(strip, bit),
                      conflicts_with(place));
    }
}

bool running() { return (turns_left() || scan_place < scan_end) && overflow == 0u; }

// Adds a block of the candidate to the active ones after it in its disk. Resumable.
bool block_conflicts(uint slot) {
    uvec4 own = sample_of(slot);
    uint cursor = slots[slot].cursor;
    uint end = min(cursor + kListPerDispatch, active_conflicts);
    for (; cursor < end; ++cursor) {
        uint at = active_entry(push.list_capacity, cursor);
        uint place = pool[list_first + (at >> 2)][at & 3u];
        block(own, place);
    }
    slots[slot].cursor = cursor;
    return cursor == active_conflicts;
}

void complete(uint slot) {
    slots[slot].phase = kSlotListed;
    slots[slot].cursor = 0u;
    complete_one();
}

void find_conflicts(uint slot) {
    own_place = slots[slot].place;
    idle_conflicts = slots[slot].idle_conflicts;
    active_conflicts = slots[slot].active_conflicts;
    turn = slots[slot].turn;
    scan_place = slots[slot].scan_place;
    scan_end = slots[slot].scan_end;
    tested = slots[slot].tested;
    rows_visited = slots[slot].rows_visited;
    overflow = 0u;
    list_first = list_row(slot);
    load_own(slot);
    for (uint i = 0u; i < push.step_budget && running(); ++i) {
        trip();
        ++own_steps;
    }
    own_steps = max(own_steps, 1u);
    slots[slot].idle_conflicts = idle_conflicts;
    slots[slot].active_conflicts = active_conflicts;
    slots[slot].turn = turn;
    slots[slot].scan_place = scan_place;
    slots[slot].scan_end = scan_end;
    slots[slot].tested = tested;
    slots[slot].rows_visited = rows_visited;
    if (overflow != 0u) {
        atomicOr(control.overflow, overflow);
    } else if (!running() && block_conflicts(slot)) {
        add_disk(rows_visited, tested, 0u, 0u, idle_conflicts + active_conflicts);
        complete(slot);
    }
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    keep_constants();
    begin_disks();
    if (slot < control.slots_used && atomic_load(control.overflow) == 0u &&
        slots[slot].phase == kSlotReady) {
        if (is_void(slot)) {
            complete(slot);
        } else {
            find_conflicts(slot);
        }
    }
    sum_disks();
}
