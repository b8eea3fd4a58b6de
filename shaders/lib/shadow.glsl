// Shadows of vertices: where paths that end at a vertex may go on. A shortest path keeps an angle
// of pi on either side of a vertex. So only what lies in the shadow of the vertex, as seen from
// where the path came, is lit through it. kernels_ref/kernels/shadow.hpp is the same in plain C++.
//
// The arrival of a path at a vertex through a corner is one word. Above kBlurBits it has the angle
// between the corner's half-edge and the path, in units of 2^-11 radian, or kArrivedAlongPrevious;
// 0 is along the half-edge. Its error is at most 2^-10 radian, times 8 for each step of the blur;
// for kMaxBlur it is not bounded. A small error keeps a little more than the shadow. Other angles
// are in units of the fans, 2^-13 radian.
#ifndef GEODISK_SHADOW_GLSL
#define GEODISK_SHADOW_GLSL

#include "fans.glsl"
#include "job.glsl"
#include "operation.glsl"

const uint kNoShadow = 0xffffffffu;
const uint kToTheEnd = 0x7fffu; // as the higher angle of a shadow

// Half-edge and angles of a corner of the fans.
uvec2 fan_corner(uint i) {
    uvec4 row = row_at(fans, job.vertices + (i >> 1));
    return (i & 1u) == 0u ? row.xy : row.zw;
}

uint corner_angles(uint h) {
    uint corners = 3u * job.faces;
    return row_at(fans, job.vertices + ((corners + 1u) >> 1) + (h >> 2))[h & 3u];
}

int corner_start(uint angles) { return int(angles & 0xffffu); }
int corner_size(uint angles) { return int((angles & ~kCornerTurned) >> 16); }

// Returns the angle between (1, 0) and (x, y), y >= 0, in units of 2^-11 radian, by formula 4.4.49 of
// Abramowitz and Stegun.
uint angle_units(float x, float y) {
    float along = abs(x);
    bool is_steep = y > along;
    float t = ratio(is_steep ? along : y, is_steep ? y : along);
    precise float t2 = t * t;
    precise float series =
        0.999866 + t2 * (-0.3302995 + t2 * (0.180141 + t2 * (-0.085133 + t2 * 0.0208351)));
    precise float shallow = t * series;
    precise float steep = 1.5707964 - shallow;
    float sharp = is_steep ? steep : shallow;
    precise float obtuse = 3.1415927 - sharp;
    precise float units = (x < 0.0 ? obtuse : sharp) * 2048.0;
    return uint(units);
}

// Returns the blur of the direction of a straight path of length `way`, at the end of a path whose distance
// has this error: the direction is off by twice the error, over the way.
uint blur_of(float error, float way) {
    precise float sharp = error * 2048.0;
    precise float dull = error * 256.0;
    precise float faint = error * 32.0;
    return (sharp > way ? 1u : 0u) + (dull > way ? 1u : 0u) + (faint > way ? 1u : 0u);
}

// Returns the arrival of a path that came from the direction (x, y), in the frame of the corner's half-edge.
uint arrival_from(float x, float y, uint blur) {
    return angle_units(x, max(y, 0.0)) << kBlurBits | blur;
}

// Enters the fan by paths that came in through corner `from`, or anywhere if that is kWholeFan.
void enter_fan(uint total_angle, uint flags, uint from, uint arrival) {
    int far = int(kFarAngle);
    bool anywhere = from == kWholeFan || (flags & kFanIrregular) != 0u;
    uint angles = corner_angles(from == kWholeFan ? 0u : from);
    int size = corner_size(angles);
    int error = int(kAngleTolerance << (3u * (arrival & kMaxBlur)));
    int own = arrival >= kArrivedAlongPrevious ? size : int(arrival >> kBlurBits) * 4;
    int low = max(own - error, 0);
    int high = min(own + error + 4, size);
    if ((arrival & kMaxBlur) == kMaxBlur || low > size) { // Beyond it by rounding.
        low = 0;
        high = size;
    }
    bool is_turned = (angles & kCornerTurned) != 0u;
    int start = corner_start(angles);
    lane.entry_low = anywhere ? -far : start + (is_turned ? size - high : low);
    lane.entry_high = anywhere ? far : start + (is_turned ? size - low : high);
    lane.entry_turn = anywhere || (flags & kFanOpen) != 0u ? far : int(total_angle);
}

// Returns the shadow in a corner with these angles: what is at least pi away from the entry on both sides,
// or on one side of an open fan. One word: the lower angle from the corner's half-edge, and the higher one
// or kToTheEnd above it; kNoShadow if there is none.
uint shadow_in(uint angles) {
    int needed = int(kAnglePi - kAngleTolerance);
    int size = corner_size(angles);
    int low = lane.entry_low + needed - corner_start(angles);
    int high = lane.entry_high - needed - corner_start(angles);
    ivec2 behind = ivec2(max(low, 0), min(high + lane.entry_turn, size));
    ivec2 before = ivec2(max(low - lane.entry_turn, 0), min(high, size));
    bool is_behind = behind.x <= behind.y;
    bool is_before = before.x <= before.y;
    ivec2 found = is_behind ? behind : before;
    if (is_behind && is_before) {
        found = ivec2(min(behind.x, before.x), max(behind.y, before.y));
    }
    if ((angles & kCornerTurned) != 0u) {
        found = ivec2(size - found.y, size - found.x);
    }
    uint end = found.y >= size ? kToTheEnd : uint(found.y);
    return is_behind || is_before ? uint(found.x) | end << 16 : kNoShadow;
}

// Returns where the ray at this angle of the corner opposite to `edge` crosses it.
float ray_crossing(uint angle) {
    precise float u = float(angle) * 0.0001220703125 - 1.5707964;
    precise float u2 = u * u;
    precise float sine_u =
        u * (1.0 + u2 * (-0.16666667 +
                         u2 * (0.0083333333 + u2 * (-0.00019841270 + u2 * 2.7557319e-6))));
    precise float cosine_u =
        1.0 + u2 * (-0.5 + u2 * (0.041666667 +
                                 u2 * (-0.0013888889 +
                                       u2 * (2.4801587e-5 + u2 * -2.7557319e-7))));
    float sine = max(cosine_u, 0.0); // A quarter of a turn on.
    precise float over = sine * (apex.x * apex.x + apex.y * apex.y);
    precise float under = (sine * apex.x + -sine_u * apex.y) * edge.len;
    precise float result = edge.len * ratio(over, under);
    return result;
}

// Returns what a shadow in the corner opposite to `edge` lights of it, wider by the slack: where the corner is
// close to the edge, rounding on the edge turns rays far.
vec2 lit_by_shadow(uint shadow) {
    uint low = shadow & 0xffffu;
    uint high = shadow >> 16;
    precise float from = ray_crossing(low) - job.slack;
    precise float to = ray_crossing(high) + job.slack;
    return vec2(low > 0u ? max(from, 0.0) : 0.0, high == kToTheEnd ? edge.len : min(to, edge.len));
}

#endif
