#version 450
#extension GL_GOOGLE_include_directive : require
// A disc of six vertices for each sample, as geodisk placed them: no vertex buffer, and no word from
// the host about how many there are.
#include "geodisk/shaders/samples.h"

layout(push_constant) uniform Camera { mat4 to_clip; } camera;
layout(set = 0, binding = 0, std430) readonly buffer placed_buffer { GeodiskPlacedRec placed[]; };
layout(location = 0) out vec3 shade;
layout(location = 1) out vec2 in_disc;

const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));

void main() {
    GeodiskPlacedRec point = placed[gl_InstanceIndex];
    vec3 normal = vec3(point.normal_x, point.normal_y, point.normal_z);
    vec3 across = normalize(cross(normal, abs(normal.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    in_disc = corners[gl_VertexIndex];
    // Disks of half the minimum distance touch, so smaller ones show each by itself.
    vec2 at = in_disc * point.radius * 0.7;
    vec3 center = vec3(point.x, point.y, point.z) + 0.02 * point.radius * normal;
    gl_Position = camera.to_clip * vec4(center + across * at.x + cross(normal, across) * at.y, 1.0);
    shade = vec3(0.95, 0.45, 0.15) * (0.5 + 0.5 * max(dot(normal, normalize(vec3(1, 2, 3))), 0.0));
}
