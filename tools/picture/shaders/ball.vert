// A square that covers a ball in space, seen from the eye: two triangles, drawn without indices.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "picture_records.h"

layout(std430, set = 0, binding = 5) readonly buffer Balls { BallRec balls[]; };
layout(push_constant, std430) uniform Push {
    mat4 to_clip;
    float eye_x; float eye_y; float eye_z;
    float light_x; float light_y; float light_z;
};

layout(location = 0) out vec3 place;
layout(location = 1) flat out uint ball_index;

void main() {
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1),
                                   vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    const vec2 corner = corners[gl_VertexIndex % 6];
    ball_index = uint(gl_VertexIndex) / 6u;
    const BallRec ball = balls[ball_index];
    const vec3 center = vec3(ball.x, ball.y, ball.z);
    const vec3 eye = vec3(eye_x, eye_y, eye_z);
    // The visible part of a ball lies within the circle in which lines from the eye touch it.
    const vec3 way = center - eye;
    const float distance = length(way);
    const vec3 axis = way / distance;
    const vec3 aside = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    const float size =
        ball.radius * distance / sqrt(distance * distance - ball.radius * ball.radius);
    place = center + size * (corner.x * aside + corner.y * cross(axis, aside));
    gl_Position = to_clip * vec4(place, 1);
}
