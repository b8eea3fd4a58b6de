// The operation in flight: a window or source, which the lane's record holds, and the face that it
// spreads over.
#ifndef GEODISK_OPERATION_GLSL
#define GEODISK_OPERATION_GLSL

#include "job.glsl"
#include "many_rows.glsl"

// The face, seen from half_edge.
Edge edge;
Edge right;         // starts where edge ends
Edge left;          // ends where edge starts
vec2 apex;          // in the frame of edge
uint cell_word;

// Used if radii vary.
float own_radius;   // of the candidate whose disk this is
vec4 radii;         // of the face

// By how much a known path must beat a window before that is dropped.
float margin;

float error_of(uint crossings) {
    precise float error = job.base_error + float(crossings) * kCrossingError;
    return error;
}

// Any path of the disk so far may have the longest chain.
void set_margin() { margin = max(job.margin, error_of(lane.longest_chain)); }

// Returns by how much the error of the operation in flight exceeds the guard: 0 but for long chains.
float beyond_guard() {
    precise float beyond = error_of(lane.chain) - (job.limit - 1.0);
    return max(beyond, 0.0);
}

// Returns the distance below which the path in flight leads to a conflict.
float path_limit() {
    precise float limit = job.limit + beyond_guard();
    return limit;
}

// Returns the same for a candidate with this radius.
float limit_with(float radius) {
    precise float guard = (job.limit - 1.0) + beyond_guard();
    precise float limit = (own_radius + radius) + guard;
    return limit;
}

// Returns the distance beyond which no path through the face leads to a conflict.
float reach() { return kAdaptive ? limit_with(radii.w) : path_limit(); }

// Returns the distance beyond which no candidate in the face conflicts.
float reach_inside() { return kAdaptive ? limit_with(largest_radius(radii)) : path_limit(); }

// Loads member by member: for a struct that is assigned as a whole, by an index from its own members,
// glslang 12 looks for `precise` without end. It does not look into functions.
void load_into(out Edge side, uint face, uint corner, uvec4 lengths) {
    side = load_edge(face, corner, lengths);
}

void load_face() {
    uint face = lane.half_edge / 3u;
    uint corner = lane.half_edge - 3u * face;
    uvec4 lengths = load_lengths(face);
    load_into(edge, face, corner, lengths);
    load_into(right, face, next_corner(corner), lengths);
    load_into(left, face, previous_corner(corner), lengths);
    apex = apex_of(edge, left);
    cell_word = kManyRows ? lengths.w : kSingleCell << kFaceCornerShift | face * push.stages;
    if (kAdaptive) {
        radii = face_radii(face);
    }
}

// A window enters the face of half_edge with its source at (entry_x, -y) in that frame.
float entry_x() {
    precise float mirrored = edge.len - lane.x;
    return lane.mode == kModeOpposite ? mirrored : lane.x;
}

vec2 entry_interval() {
    precise float low = edge.len - lane.b1;
    precise float high = edge.len - lane.b0;
    return lane.mode == kModeOpposite ? vec2(low, high) : vec2(lane.b0, lane.b1);
}

float squared(float dx, float dy) {
    precise float square = dx * dx + dy * dy;
    return square;
}

#endif
