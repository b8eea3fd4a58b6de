// The ball that covers the pixel, or nothing of it; or where it is cut, its section.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "picture_records.h"
#include "colors.glsl"

layout(std430, set = 0, binding = 5) readonly buffer Balls { BallRec balls[]; };
layout(push_constant, std430) uniform Push {
    mat4 to_clip;
    float eye_x; float eye_y; float eye_z;
    float light_x; float light_y; float light_z;
    float high;
    uint cuts;
};

layout(location = 0) in vec3 place;
layout(location = 1) flat in uint ball_index;

layout(location = 0) out vec4 color;

void main() {
    const BallRec ball = balls[ball_index];
    const vec3 eye = vec3(eye_x, eye_y, eye_z);
    const vec3 ray = normalize(place - eye);
    const vec3 to_center = vec3(ball.x, ball.y, ball.z) - eye;
    const float middle = dot(to_center, ray);
    const vec3 aside = to_center - middle * ray;
    const float squared = ball.radius * ball.radius - dot(aside, aside);
    if (squared <= 0.0) {
        discard;
    }
    const float half_chord = sqrt(squared);
    vec3 hit = eye + (middle - half_chord) * ray;
    vec3 normal = hit - vec3(ball.x, ball.y, ball.z); // Of any length.
    bool is_section = false;
    if (cuts != 0u) {
        // The ray leaves the eye's eighth where it first comes to a plane of two axes.
        const vec3 side = mix(vec3(-1), vec3(1), greaterThanEqual(eye, vec3(0)));
        const vec3 ways = mix(vec3(1e30), -eye / ray, lessThan(ray * side, vec3(0)));
        const float leaves = min(ways.x, min(ways.y, ways.z));
        if (leaves >= middle + half_chord) {
            discard;
        }
        is_section = leaves > middle - half_chord;
        if (is_section) {
            hit = eye + leaves * ray;
            normal = side * vec3(equal(ways, vec3(leaves)));
        }
    }
    const vec4 at = to_clip * vec4(hit, 1);
    gl_FragDepth = clamp(at.z / at.w, 0.0, 1.0);
    // Darker the deeper in the scene, which lies within 1 of the origin, and each a little different.
    const float depth = clamp((distance(hit, eye) - length(eye) + 1.0) / 2.0, 0.0, 1.0);
    const vec3 tint = mix(vec3(0.42, 0.70, 0.92), kSky, float(ball.color % 8u) / 8.0);
    const vec3 matte = is_section ? kBare : mix(tint, kBlue * 0.5, depth * depth);
    color = vec4(shade(matte, normalize(normal), -ray, vec3(light_x, light_y, light_z)), 1);
}
