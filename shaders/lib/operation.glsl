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

layout(constant_id = kSpecAvoids) const bool kAvoids = false;

uint own_place; // of the candidate whose disk this is, kNoPlace for a settled sample

// If radii vary, the radius of the candidate whose disk this is; with classes the largest distance of its
// class. For a point to avoid minus its radius.
float own_radius;
float own_scale; // what lengths are multiplied by, see scale_of(); 1 but for a point to avoid
uint own_class; // of a point to avoid the class that it keeps out + 1, or 0 for all
vec4 radii;         // of the face, if radii vary

// Returns true for the disk of a point to avoid. It keeps out all candidates, whatever their radii.
bool keeps_out() { return kAvoids && own_radius < 0.0; }

// Returns false for the disk of a point that keeps out another class alone.
bool keeps_out_class(uint other_class) {
    return !kAvoids || !kClasses || own_class == 0u || own_class == other_class + 1u;
}

// Returns what lengths are multiplied by in the disk of a point to avoid with this radius, 0 for other disks:
// a power of two, so that distances stay below 2 and lengths exact.
float scale_of(float radius) {
    uint exponent = floatBitsToUint(radius) & 0x7f800000u;
    return kAvoids && radius > 1.0 ? uintBitsToFloat(0x7e800000u - exponent) : 1.0;
}

// Returns the distance below which candidates conflict, if radii do not vary and without long chains. With
// classes that is the largest one.
float own_limit() {
    precise float avoided = (job.limit - 1.0) - own_radius * own_scale;
    precise float of_class = (job.limit - 1.0) + own_radius;
    return keeps_out() ? avoided : (kClasses ? of_class : job.limit);
}

// By how much a known path must beat a window before that is dropped.
float margin;

float error_of(uint crossings) {
    precise float error = job.base_error + float(crossings) * crossing_error();
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
    precise float limit = own_limit() + beyond_guard();
    return limit;
}

// Returns the same for a candidate with this radius.
float limit_with(float radius) {
    precise float guard = (job.limit - 1.0) + beyond_guard();
    precise float limit = (own_radius + radius) + guard;
    return keeps_out() ? path_limit() : limit;
}

// Returns the same for a candidate of this class: 0 if the two classes keep no distance.
float limit_for(uint other_class) {
    precise float guard = (job.limit - 1.0) + beyond_guard();
    float distance = class_distance(own_class, other_class);
    precise float limit = distance + guard;
    return distance > 0.0 ? limit : 0.0;
}

// Returns the distance beyond which no path through the face leads to a conflict.
float reach() { return kAdaptive ? limit_with(radii.w) : path_limit(); }

// Returns the distance beyond which no candidate in the face conflicts.
float reach_inside() { return kAdaptive ? limit_with(largest_radius(radii)) : path_limit(); }

// Returns the lengths of a face in the scale of the disk.
uvec4 scaled_lengths(uint face) {
    uvec4 lengths = load_lengths(face);
    precise vec3 scaled = uintBitsToFloat(lengths.xyz) * own_scale;
    return kAvoids ? uvec4(floatBitsToUint(scaled), lengths.w) : lengths;
}

// Returns the cells per unit of length in the scale of the disk.
float scaled_cells_per_unit() {
    float cells = cells_per_unit(radii);
    precise float scaled = cells * uintBitsToFloat(0x7f000000u - floatBitsToUint(own_scale));
    return kAvoids ? scaled : cells;
}

// Loads member by member: for a struct that is assigned as a whole, by an index from its own members,
// glslang 12 looks for `precise` without end. It does not look into functions.
void load_into(out Edge side, uint face, uint corner, uvec4 lengths) {
    side = load_edge(face, corner, lengths);
}

void load_face() {
    uint face = lane.half_edge / 3u;
    uint corner = lane.half_edge - 3u * face;
    uvec4 lengths = scaled_lengths(face);
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
