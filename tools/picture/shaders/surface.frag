// The colour of a surface by the exact geodesic distances of the samples that reach the place.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "picture_records.h"
#include "colors.glsl"

layout(constant_id = 0) const uint kDraw = kDrawDisks;

layout(std430, set = 0, binding = 1) readonly buffer Faces { FaceRec faces[]; };
layout(std430, set = 0, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, set = 0, binding = 3) readonly buffer Windows { WindowRec windows[]; };
layout(std430, set = 0, binding = 4) readonly buffer Samples { SampleRec samples[]; };
layout(push_constant, std430) uniform Push {
    layout(offset = 64) float eye_x; float eye_y; float eye_z;
    float light_x; float light_y; float light_z;
    float high;
};

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 in_face;
layout(location = 3) flat in uint face_index;
layout(location = 4) in float value;

layout(location = 0) out vec4 color;

// Windows light this much more than they do, in units of length, so that rounding leaves no seams.
const float kSeam = 2e-4;

FaceRec face_at(uint index) { return faces[index]; }
uint cell_start(uint cell) { return starts[cell]; }
WindowRec window_at(uint index) { return windows[index]; }
float radius_of(uint index) { return samples[index].radius; }
uint kind_of(uint index) { return samples[index].kind; }
bool is_shown(uint index) { return true; }
#include "nearest.glsl"

// Returns the colour of the surface itself, light apart.
vec3 surface_color(Nearest nearest, float density) {
    const bool has_sample = nearest.sample_index != ~0u;
    const float q = nearest.first;
    if (kDraw == kDrawDisks) {
        if (!has_sample || q >= 1.0) {
            return kBare;
        }
        return nearest.overlaps ? kOverlap : disk_color(q, kind_of(nearest.sample_index));
    }
    if (kDraw == kDrawPoints) {
        if (!has_sample || q >= high) {
            return kBare;
        }
        const uint kind = kind_of(nearest.sample_index);
        return kind == 0u ? kMark : class_color(kind);
    }
    if (kDraw == kDrawVoronoi) {
        if (!has_sample) {
            return kBare;
        }
        const float border = nearest.second - q;
        const SampleRec own = samples[nearest.sample_index];
        return q < 0.12 || border < 1.0 / float(kBordersPerRadius) ? kMark : cell_color(own.color, own.kind);
    }
    if (kDraw == kDrawDistance) {
        return has_sample ? distance_color(q) : kOverlap;
    }
    return scale_color(sqrt(density / high));
}

void main() {
    const vec3 to_eye = normalize(vec3(eye_x, eye_y, eye_z) - place);
    // A surface may be seen from either side.
    const float size = length(normal);
    vec3 up = size > 0.0 ? normal / size : to_eye;
    const float facing = dot(up, to_eye);
    up = facing < 0.0 ? -up : up;
    if (kDraw == kDrawArea) {
        const float tilt = 1.0 / max(abs(facing), 1.0 / float(kMaxTilt));
        color = vec4(vec3(tilt / float(kMaxTilt)), 1);
        return;
    }
    if (kDraw == kDrawFrame) {
        color = vec4(kMark, 1);
        return;
    }
    vec3 matte;
    if (kDraw == kDrawValues) {
        matte = value < 0.0 ? kBare : lined_color(value / high);
    } else {
        float density;
        const Nearest nearest = look_up(face_index, in_face, density);
        matte = surface_color(nearest, density);
    }
    const vec3 lit = shade(matte, up, to_eye, vec3(light_x, light_y, light_z));
    // A colour that is an amount is left mostly as it is by light and shadow.
    color = vec4(mix(lit, matte, kDraw == kDrawDensity ? 0.6 : 0.0), 1);
}
