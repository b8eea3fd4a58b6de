precision highp float;
precision highp int;

uniform int task; // As of the surface.
uniform vec3 ink, mark;

flat in uint number;
flat in int is_marked;

out vec4 color;

void main() {
    if (length(gl_PointCoord - 0.5) > 0.5) {
        discard;
    }
    if (task == 1) {
        uvec3 bytes = uvec3(number + 1u, (number + 1u) >> 8u, (number + 1u) >> 16u) & 255u;
        color = vec4(vec3(bytes) / 255.0, 1);
    } else {
        color = vec4(is_marked == 1 ? mark : ink, 1);
    }
}
