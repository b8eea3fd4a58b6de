#version 450
layout(location = 0) in vec3 shade;
layout(location = 1) in vec2 in_disc;
layout(location = 0) out vec4 color;

void main() {
    if (dot(in_disc, in_disc) > 1.0) {
        discard;
    }
    color = vec4(shade, 1.0);
}
