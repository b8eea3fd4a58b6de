#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the samples that are in order to the caller's buffer, with position, normal and radius, and
// their number to the arguments of an indirect draw. One invocation per sample.
// reads: samples, control, fans (radii, parts), vertices, indices   writes: placed, arguments
// spec: local size, rounding, adaptive, several

#define GEODISK_OWN_PUSH PlacePush
#include "../lib/prelude.glsl"
#include "../lib/rounding.glsl"
#include "../lib/radii.glsl"
#include "../lib/parts.glsl"

layout(local_size_x_id = 0) in; // kSpecLocalSize

GEODISK_BUFFER(kBindSamples, readonly, uvec4, samples);
GEODISK_BUFFER(kBindVertices, readonly, float, vertices);
GEODISK_BUFFER(kBindIndices, readonly, uint, indices);
GEODISK_BUFFER(kBindPlaced, writeonly, uvec4, placed);
GEODISK_BUFFER(kBindArguments, writeonly, uint, arguments);
GEODISK_CONTROL;

// Returns the vertex of a corner of a face, clamped: wrong indices of the caller must not read
// elsewhere.
uint vertex_of(uint corner) {
    uint vertex = indices[push.short_indices != 0u ? corner >> 1 : corner];
    if (push.short_indices != 0u) {
        vertex = (corner & 1u) != 0u ? vertex >> 16 : vertex & 0xffffu;
    }
    return min(vertex, push.last_vertex);
}

vec3 vertex_at(uint vertex, uint offset) {
    uint at = vertex * push.stride + offset;
    return vec3(vertices[at], vertices[at + 1u], vertices[at + 2u]);
}

vec3 weighed(vec3 a, vec3 b, vec3 c, vec3 weights) {
    precise vec3 sum = (a * weights.x + b * weights.y) + c * weights.z;
    return sum;
}

// Returns v times a power of two, so that the largest coordinate is about 1.
vec3 about_unit(vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    float scale = uintBitsToFloat(0x7f000000u - (floatBitsToUint(largest) & 0x7f800000u));
    precise vec3 scaled = v * scale;
    return scaled;
}

float signed_ratio(float a, float b) { return a < 0.0 ? -ratio(-a, b) : ratio(a, b); }

// Returns the unit vector, or zero for the zero vector.
vec3 direction_of(vec3 v) {
    vec3 w = about_unit(v);
    precise float square = (w.x * w.x + w.y * w.y) + w.z * w.z;
    float len = root(square);
    return len > 0.0 ? vec3(signed_ratio(w.x, len), signed_ratio(w.y, len), signed_ratio(w.z, len))
                     : vec3(0.0);
}

vec3 face_normal(vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    vec3 u = about_unit(ab);
    vec3 v = about_unit(ac);
    precise float x = u.y * v.z - u.z * v.y;
    precise float y = u.z * v.x - u.x * v.z;
    precise float z = u.x * v.y - u.y * v.x;
    return direction_of(vec3(x, y, z));
}

float radius_of(uint face, uint part, float weight1, float weight2) {
    float largest = kSeveral ? uintBitsToFloat(part_word(part, 4u)) : push.radius;
    if (!kAdaptive) {
        return largest;
    }
    precise float radius = (2.0 * radius_at(face_radii(face), weight1, weight2)) * largest;
    return radius;
}

void main() {
    uint i = own_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint count = min(control.ready - min(control.ready, push.avoided), push.most);
    if (i == 0u) {
        arguments[0] = push.vertices_each;
        arguments[1] = count;
        arguments[2] = 0u;
        arguments[3] = 0u;
    }
    if (i >= count) {
        return;
    }
    uvec4 own = samples[push.avoided + i];
    uint face = own.y;
    float weight1 = uintBitsToFloat(own.z);
    float weight2 = uintBitsToFloat(own.w);
    precise float weight0 = (1.0 - weight1) - weight2;
    vec3 weights = vec3(weight0, weight1, weight2);
    uint part = kSeveral ? part_of(face) : 0u;
    uint first_face = kSeveral ? part_word(part, 5u) : 0u;
    uvec3 corner = uvec3(vertex_of(3u * face), vertex_of(3u * face + 1u), vertex_of(3u * face + 2u));
    vec3 a = vertex_at(corner.x, push.position);
    vec3 b = vertex_at(corner.y, push.position);
    vec3 c = vertex_at(corner.z, push.position);
    vec3 normal;
    if (push.has_normals != 0u) {
        normal = direction_of(weighed(vertex_at(corner.x, push.normal), vertex_at(corner.y, push.normal),
                                      vertex_at(corner.z, push.normal), weights));
    } else {
        normal = face_normal(a, b, c);
    }
    uvec3 position = floatBitsToUint(weighed(a, b, c, weights));
    uint radius = floatBitsToUint(radius_of(face, part, weight1, weight2));
    placed[kPlacedRows * i] = uvec4(position, radius);
    placed[kPlacedRows * i + 1u] = uvec4(floatBitsToUint(normal), face - first_face);
    placed[kPlacedRows * i + 2u] = uvec4(own.z, own.w, part, own.x);
}
