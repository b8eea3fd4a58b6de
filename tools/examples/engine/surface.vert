#version 450
// The surface itself.
layout(push_constant) uniform Camera { mat4 to_clip; } camera;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 shade;
layout(location = 1) out vec2 in_disc;

void main() {
    gl_Position = camera.to_clip * vec4(position, 1.0);
    shade = vec3(0.55, 0.6, 0.7) * (0.35 + 0.65 * max(dot(normalize(normal), normalize(vec3(1, 2, 3))), 0.0));
    in_disc = vec2(0.0);
}
