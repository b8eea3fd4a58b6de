// Windows (improved Chen-Han: Xin and Wang 2009; one angle one split: Chen and Han 1990) cut at the
// limit. kernels_ref/kernels/detect.hpp is the same in plain C++ and easier to read first.
//
// A window is kept in the frame of the half-edge it leaves its face through: source at (x, y), y >=
// 0, lit interval [b0, b1]. Rows: (edge, x, y, b0), (b1, sigma, chain, corner). A vertex event has
// the marked vertex for the edge and in `corner` where its path came in.
#ifndef GEODISK_PROPAGATE_GLSL
#define GEODISK_PROPAGATE_GLSL

// The operation in flight, see SlotRec.
uint half_edge;
Edge edge;          // of half_edge
uint mode;
float x;
float y;
float b0;
float b1;
float sigma;
uint chain;
uint window_edge;
uint entered_by;    // of an event: the corner; of a window: what was known of the edge's ends
uint longest_chain;

void push_record(float key, uvec4 row0, uvec4 row1) {
    longest_chain = max(longest_chain, chain + 1u);
    push_window(key, row0, row1);
}

// Whether `known` plus a straight way beats the window's own distance to a point at this squared
// distance from its source, by more than the margin.
bool beats(float known, float way, float own_square) {
    precise float rest = ((known + way) - sigma) + push.margin;
    precise float square = rest * rest;
    return rest < 0.0 || square < own_square;
}

float squared(float dx, float dy) {
    precise float square = dx * dx + dy * dy;
    return square;
}

// A path of this length ends at the vertex, having come in through `corner`. Returns what is now
// known of the vertex; `key` stays negative unless an event is due.
float reach(uint vertex, float known, float distance, uint corner, uint through, float crossing,
            bool whole_fan, inout float key, out uvec4 row0, out uvec4 row1) {
    row0 = uvec4(0u);
    row1 = uvec4(0u);
    if (!(distance < known) || !(distance < push.limit)) {
        return known;
    }
    note_vertex(vertex, distance, through, crossing);
    if (whole_fan || (fans[vertex].w & kFanBends) != 0u) {
        key = distance;
        row0.x = vertex | kVertexEvent;
        row1 = uvec4(0u, floatBitsToUint(distance), chain + 1u, whole_fan ? kWholeFan : corner);
    }
    return distance;
}

// A known distance as a window carries it: in steps of 2^-15, never less. A bound too large only
// lets a window live that could be dropped.
const uint kUnknownSteps = 0xffffu;

uint steps_up(float distance) {
    precise float steps = distance * 32768.0;
    return distance < push.limit ? uint(steps) + 1u : kUnknownSteps;
}

float from_steps(uint steps) {
    precise float distance = float(steps) * 3.0517578125e-5;
    return steps == kUnknownSteps ? kFar : distance;
}

// A window leaves through half-edge e, lit on [i0, i1] from (sx, sy) in its frame. `key` stays
// negative unless it is to be pushed.
void leave(uint e, Edge exit_edge, float start, float end, float sx, float sy, float i0,
           float i1, inout float key, out uvec4 row0, out uvec4 row1) {
    row0 = uvec4(0u);
    row1 = uvec4(0u);
    if (exit_edge.border || !(i0 < i1)) {
        return;
    }
    sy = sy < kSmallestOffset ? 0.0 : sy;
    // From the edge's own end nothing but the edge is lit: that vertex lights its fan itself, and
    // rounding could carry the window around it for ever.
    precise float grain = exit_edge.len * kEdgeGrain;
    precise float from_end = exit_edge.len - sx;
    if (sy == 0.0 && (sx <= grain || from_end <= grain)) {
        return;
    }
    if (chain >= kLongestChain) {
        overflow |= kOverflowChain;
        return;
    }
    precise float left_of = i0 - sx;
    precise float right_of = sx - i1;
    float aside = sx < i0 ? left_of : (sx > i1 ? right_of : 0.0);
    precise float distance = sigma + root(squared(aside, sy));
    precise float to_end = exit_edge.len - i0;
    if (!(distance < push.limit) || beats(start, i1, squared(right_of, sy)) ||
        beats(end, to_end, squared(-left_of, sy))) {
        return;
    }
    key = distance;
    row0 = uvec4(e, floatBitsToUint(sx), floatBitsToUint(sy), floatBitsToUint(i0));
    row1 = uvec4(floatBitsToUint(i1), floatBitsToUint(sigma), chain + 1u,
                 steps_up(start) | steps_up(end) << 16);
}

// How far along a child edge the ray through b falls, for a source at (sx, -sy), all measured from
// the corner that parent and child share.
float along(float b, float sx, float sy, float apex_x, float apex_y, float child_length) {
    precise float over = sy * b;
    precise float under = sy * apex_x + apex_y * (sx - b);
    precise float result = child_length * ratio(over, under);
    return result;
}

// The window in flight enters the face of half_edge; the source then lies at (entry_x, -y) in its
// frame.
float entry_x(float len) {
    precise float mirrored = len - x;
    return mode == kModeOpposite ? mirrored : x;
}

vec2 entry_interval(float len) {
    precise float low = len - b1;
    precise float high = len - b0;
    return mode == kModeOpposite ? vec2(low, high) : vec2(b0, b1);
}

// The child of the window that enters at (sx, [i0, i1]) over the left or right edge of the face.
void spread_child(bool left, bool whole, float sx, float near, float far, Edge parent, uint e,
                  Edge child, float start, float end, float third, Turn angle, inout float key,
                  out uvec4 row0, out uvec4 row1) {
    precise float mirrored_apex = parent.len - parent.apex_x;
    float apex_x = left ? parent.apex_x : mirrored_apex;
    float low = along(near, sx, y, apex_x, parent.apex_y, child.len);
    float high = child.len;
    if (!whole) {
        high = along(far, sx, y, apex_x, parent.apex_y, child.len);
    }
    precise float child_x = sx * angle.cosine - y * angle.sine;
    precise float child_y = sx * angle.sine + y * angle.cosine;
    precise float turned_x = child.len - child_x;
    precise float turned_low = child.len - high;
    precise float turned_high = child.len - low;
    float px = left ? turned_x : child_x;
    float i0 = left ? turned_low : low;
    float i1 = left ? turned_high : high;
    float b = left ? i1 : i0;
    precise float apex_dx = child.apex_x - b;
    precise float own_dx = px - b;
    row0 = uvec4(0u);
    row1 = uvec4(0u);
    if (!beats(third, root(squared(apex_dx, child.apex_y)), squared(own_dx, child_y))) {
        leave(e, child, start, end, px, child_y, i0, i1, key, row0, row1);
    }
}

// How the window in flight meets the apex of the face it enters.
struct Meeting {
    float crossing;       // where the ray to the apex crosses half_edge
    float apex_distance;
    bool sees_apex;
    bool to_left;         // a child goes over the left edge, from the apex on if the other does too
    bool to_right;
    bool reaches_left;    // the interval lies to the left of the apex, at least in part
    bool reaches_right;
};

Meeting meet_apex(float sx, vec2 lit, uvec4 apex_note) {
    Meeting m;
    precise float apex_dx = edge.apex_x - sx;
    precise float apex_dy = edge.apex_y + y;
    precise float crossing = sx + apex_dx * ratio(y, apex_dy);
    precise float apex_distance = sigma + root(squared(apex_dx, apex_dy));
    precise float slack_low = lit.x - push.slack;
    precise float slack_high = lit.y + push.slack;
    m.crossing = crossing;
    m.apex_distance = apex_distance;
    m.sees_apex = crossing >= slack_low && crossing <= slack_high;
    m.reaches_left = crossing > lit.x;
    m.reaches_right = crossing < lit.y;
    m.to_left = m.reaches_left;
    m.to_right = m.reaches_right;
    if (push.splits_once != 0u && m.sees_apex && m.to_left && m.to_right && apex_note.x != 0u &&
        apex_note.z == half_edge) {
        // One angle, one split: behind a shorter window through the same angle only the child on
        // this window's own side can matter. Rays that cross at one place within rounding do not
        // tell which side is whose.
        precise float beaten_from = uintBitsToFloat(apex_note.y) + push.margin;
        precise float left_of = uintBitsToFloat(apex_note.w) - push.slack;
        precise float right_of = uintBitsToFloat(apex_note.w) + push.slack;
        if (apex_distance > beaten_from) {
            m.to_right = crossing >= left_of;
            m.to_left = crossing <= right_of;
        }
    }
    return m;
}

// What the operation in flight does to vertices and edges: at most three records, pushed from one
// place, first those of vertices. `from_vertex` tells a fan from the candidate's own face, where
// `source_square` is the squared distance to the edge's start and `near_vertex` whether that is as
// good as nothing.
void spread(bool from_vertex, float source_square, bool near_vertex) {
    uint left = previous_in_face(half_edge);
    uint right = next_in_face(half_edge);
    Edge left_edge = load_edge(left);
    Edge right_edge = load_edge(right);
    bool inside = mode == kModeInside;
    // Start, end and apex of the edge. A window brings what was known of the ends when it set out.
    uvec3 corner = uvec3(edge.origin, right_edge.origin, left_edge.origin);
    bool turned = mode == kModeOpposite;
    vec3 known = vec3(from_steps(turned ? entered_by >> 16 : entered_by & 0xffffu),
                      from_steps(turned ? entered_by & 0xffffu : entered_by >> 16), kFar);
    uvec4 note;
    for (uint i = inside ? 0u : 2u; i != (inside ? 2u : 3u); ++i) {
        ++trips;
        find_vertex(corner[i], note);
        known[i] = known_distance(note);
    }
    float sx = entry_x(edge.len);
    vec2 lit = entry_interval(edge.len);
    Meeting apex = meet_apex(sx, lit, note);
    precise float start_distance = sigma + (from_vertex ? left_edge.len : root(source_square));
    precise float end_distance = sigma + right_edge.len;
    Turn own_angle = load_turn(half_edge);
    Turn right_angle = load_turn(right);

    for (uint item = 0u; item < 3u; ++item) {
        ++trips;
        float key = -1.0;
        uvec4 row0 = uvec4(0u);
        uvec4 row1 = uvec4(0u);
        if (item == 0u || (item == 1u && inside)) {
            uint at = inside ? item : 2u;
            if (inside ? (item == 0u || from_vertex) : apex.sees_apex) {
                float distance = inside ? (item == 0u ? start_distance : end_distance)
                                        : apex.apex_distance;
                uint by = inside ? (item == 0u ? half_edge : right) : left;
                known[at] =
                    reach(corner[at], known[at], distance, by, inside ? kNoHalfEdge : half_edge,
                          inside ? 0.0 : apex.crossing, near_vertex && item == 0u, key, row0, row1);
            }
        } else if (inside) {
            leave(half_edge, edge, known.x, known.y, x, y, 0.0, edge.len, key, row0, row1);
        } else if (item == 1u ? apex.to_left : apex.to_right) {
            bool is_left = item == 1u;
            precise float mirrored = edge.len - sx;
            precise float from_end = edge.len - lit.y;
            precise float from_start = edge.len - lit.x;
            spread_child(is_left, is_left ? apex.reaches_right : apex.reaches_left,
                         is_left ? sx : mirrored, is_left ? lit.x : from_end,
                         is_left ? lit.y : from_start, edge, is_left ? left : right,
                         is_left ? left_edge : right_edge, is_left ? known.z : known.y,
                         is_left ? known.x : known.z, is_left ? known.y : known.x,
                         is_left ? own_angle : right_angle, key, row0, row1);
        }
        if (key >= 0.0) {
            push_record(key, row0, row1);
        }
    }
}

#endif
