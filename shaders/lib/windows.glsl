// Windows (improved Chen-Han: Xin and Wang 2009; one angle, one split: Chen and Han 1990), cut at the
// limit: how they cross a face. kernels_ref/kernels/windows.hpp is the same in plain C++; read that first.
//
// A window is stored in the frame of the half-edge through which it leaves its face: source at (x, y), y
// >= 0, lit interval [b0, b1]. Rows: (next half-edge around the edge, with its direction bit, x, y, b0),
// (b1, sigma, chain, known).
#ifndef GEODISK_WINDOWS_GLSL
#define GEODISK_WINDOWS_GLSL

#include "job.glsl"
#include "operation.glsl"

// Returns true if `distance` plus a straight path beats the window's own distance to a point, at this
// squared distance from its source, by more than the margin.
bool beats(float distance, float way, float own_square) {
    precise float rest = ((distance + way) - lane.sigma) + margin;
    precise float square = rest * rest;
    return rest < 0.0 || square < own_square;
}

// A window carries known distances rounded up to multiples of 2^-15. A bound that is too large only
// keeps a window that could be dropped.
const uint kUnknownSteps = 0xffffu;

uint steps_up(float distance) {
    precise float steps = distance * 32768.0;
    return distance < job.limit ? uint(steps) + 1u : kUnknownSteps;
}

float from_steps(uint steps) {
    precise float distance = float(steps) * 3.0517578125e-5;
    return steps == kUnknownSteps ? kFar : distance;
}

// Returns the known distances of start and end of half_edge when the window in flight was made. If many
// faces share the edge, the window carries its own half-edge instead.
vec2 known_ends() {
    bool turned = lane.mode == kModeOpposite;
    uint low = lane.known & 0xffffu;
    uint high = lane.known >> 16;
    bool unknown = lane.mode == kModeInside || (edge.origin & kManyFaces) != 0u;
    return vec2(unknown ? kFar : from_steps(turned ? high : low),
                unknown ? kFar : from_steps(turned ? low : high));
}

// Returns the position on a child edge of the ray through b, for a source at (sx, -sy), measured from
// the corner that parent and child share.
float along(float b, float sx, float sy, vec2 top, float child_length) {
    precise float over = sy * b;
    precise float under = sy * top.x + top.y * (sx - b);
    precise float result = child_length * ratio(over, under);
    return result;
}

// Relation of the window in flight to the apex of the face it enters.
struct Meeting {
    float crossing;       // where the ray to the apex crosses half_edge
    float way;            // from the source straight to the apex
    float distance;       // of the apex
    bool sees_apex;
    bool to_left;         // a child crosses the left edge, from the apex on if another crosses the right
                          // edge
    bool to_right;
    bool reaches_left;    // the interval is at least partly left of the apex
    bool reaches_right;
};

Meeting meet_apex(float sx, vec2 lit) {
    Meeting m;
    precise float apex_dx = apex.x - sx;
    precise float apex_dy = apex.y + lane.y;
    precise float crossing = sx + apex_dx * ratio(lane.y, apex_dy);
    float way = root(squared(apex_dx, apex_dy));
    precise float distance = lane.sigma + way;
    precise float slack_low = lit.x - job.slack;
    precise float slack_high = lit.y + job.slack;
    m.crossing = crossing;
    m.way = way;
    m.distance = distance;
    m.sees_apex = crossing >= slack_low && crossing <= slack_high;
    m.reaches_left = crossing > lit.x;
    m.reaches_right = crossing < lit.y;
    m.to_left = m.reaches_left;
    m.to_right = m.reaches_right;
    return m;
}

// One angle, one split: after a shorter window through the same angle, which reached the apex at
// `distance` and crossed half_edge at `crossing`, only the child on this window's own side matters. If
// both rays cross at the same position within rounding, the sides are ambiguous.
void split_once(inout Meeting m, bool same_angle, float distance, float crossing) {
    if ((job.path_rules & kRuleSplitsOnce) != 0u && m.sees_apex && m.to_left && m.to_right && same_angle) {
        precise float beaten_from = distance + margin;
        precise float left_of = crossing - job.slack;
        precise float right_of = crossing + job.slack;
        if (m.distance > beaten_from) {
            m.to_right = m.crossing >= left_of;
            m.to_left = m.crossing <= right_of;
        }
    }
}

// A window to push; none if its distance is negative.
struct Window {
    float distance;
    uvec4 row0;
    uvec4 row1;
};

const Window kNoChild = Window(-1.0, uvec4(0u), uvec4(0u));

// Returns the window with which the operation in flight leaves the face: from inside through half_edge
// itself, as a window through the left or right edge.
Window leave(bool is_left, Meeting m, float sx, vec2 lit, vec3 distances) {
    bool inside = lane.mode == kModeInside;
    Edge child = left;
    Edge before = right; // ends where child starts
    if (!is_left) {
        child = right;
        before = edge;
    }
    vec2 child_apex = apex_of(child, before);
    // Measured from the corner that half_edge and child share.
    precise float from_end = edge.len - sx;
    precise float apex_from_end = edge.len - apex.x;
    precise float low_from_end = edge.len - lit.y;
    precise float high_from_end = edge.len - lit.x;
    float source = is_left ? sx : from_end;
    vec2 top = vec2(is_left ? apex.x : apex_from_end, apex.y);
    float low = along(is_left ? lit.x : low_from_end, source, lane.y, top, child.len);
    float high = along(is_left ? lit.y : high_from_end, source, lane.y, top, child.len);
    if (is_left ? m.reaches_right : m.reaches_left) {
        high = child.len;
    }
    float cosine = is_left ? edge.cosine : right.cosine;
    float sine = is_left ? edge.sine : right.sine;
    precise float child_x = source * cosine - lane.y * sine;
    precise float child_y = source * sine + lane.y * cosine;
    precise float turned_x = child.len - child_x;
    precise float turned_low = child.len - high;
    precise float turned_high = child.len - low;

    uint out_edge = lane.half_edge;
    uint around = edge.around;
    uint origin = edge.origin;
    float len = edge.len;
    vec2 ends = distances.xy; // known of the edge's start and end
    float px = lane.x;
    float py = lane.y;
    float i0 = lane.b0;
    float i1 = lane.b1;
    bool useless = false;
    if (!inside) {
        uint next = next_in_face(lane.half_edge);
        out_edge = is_left ? next_in_face(next) : next;
        around = child.around;
        origin = child.origin;
        len = child.len;
        ends = is_left ? vec2(distances.z, distances.x) : vec2(distances.y, distances.z);
        px = is_left ? turned_x : child_x;
        py = child_y;
        i0 = is_left ? turned_low : low;
        i1 = is_left ? turned_high : high;
        // Xin and Wang's filter with the third corner of the face, at the apex of the child, against the
        // end of the lit interval next to half_edge.
        float b = is_left ? i1 : i0;
        precise float apex_dx = child_apex.x - b;
        precise float own_dx = px - b;
        useless = beats(is_left ? distances.y : distances.x,
                        root(squared(apex_dx, child_apex.y)), squared(own_dx, py));
    }
    py = py < kSmallestOffset ? 0.0 : py;
    // A source at an end of the edge lights only the edge: that vertex lights its fan itself, and
    // rounding could carry the window around it forever.
    precise float grain = len * kEdgeGrain;
    precise float beyond = len - px;
    bool on_end = py == 0.0 && (px <= grain || beyond <= grain);
    // Xin and Wang's filter with the two ends of the edge.
    precise float left_of = i0 - px;
    precise float right_of = px - i1;
    float aside = px < i0 ? left_of : (px > i1 ? right_of : 0.0);
    precise float distance = lane.sigma + root(squared(aside, py));
    precise float to_end = len - i0;
    bool border = around >> 1 == out_edge;
    if (useless || border || on_end || !(i0 < i1) || !(distance < reach()) ||
        beats(ends.x, i1, squared(right_of, py)) || beats(ends.y, to_end, squared(left_of, py))) {
        return kNoChild;
    }
    if (lane.chain >= kLongestChain) {
        overflow |= kOverflowEndless;
        return kNoChild;
    }
    return Window(distance,
                  uvec4(around, floatBitsToUint(px), floatBitsToUint(py), floatBitsToUint(i0)),
                  uvec4(floatBitsToUint(i1), floatBitsToUint(lane.sigma), lane.chain + 1u,
                        (origin & kManyFaces) != 0u ? out_edge
                                                    : steps_up(ends.x) | steps_up(ends.y) << 16));
}

// Returns true if the window in flight returns to a face where it has been; shortest paths do not, if
// faces are straight. A window with a long chain remembers one face, where its chain was last a power of
// two, and so finds every cycle (Brent 1980).
bool turns_back() {
    return kRemembers && (job.path_rules & kRuleStraightFaces) != 0u && lane.phase == kPhaseCross &&
           lane.half_edge / 3u == lane.remembered / 3u;
}

// Returns what the windows remember that the operation in flight makes.
uint remember() {
    uint chain = lane.chain + 1u;
    if (chain < kFirstRemembered) {
        return kNoHalfEdge;
    }
    bool renews = lane.mode == kModeInside || (chain & (chain - 1u)) == 0u;
    return renews ? lane.half_edge : lane.remembered;
}

// Returns true if the window in flight also enters another face of its edge, which is not the one it
// came from.
bool enters_more() { return (edge.origin & kManyFaces) != 0u && edge.around >> 1 != lane.known; }

#endif
