precision highp float;
precision highp int;

#include "colors.glsl"

uniform int task; // As of the surface.
uniform vec3 ink, mark;
uniform bool shows_disks, has_disks; // Which have the colours of classes.

flat in uint number;
flat in int is_marked;
flat in uint own_kind;

out vec4 color;

void main() {
    if (length(gl_PointCoord - 0.5) > 0.5) {
        discard;
    }
    if (task == 1) {
        uvec3 bytes = uvec3(number + 1u, (number + 1u) >> 8u, (number + 1u) >> 16u) & 255u;
        color = vec4(vec3(bytes) / 255.0, 1);
    } else {
        bool has_class = own_kind > 0u && !(shows_disks && has_disks);
        color = vec4(is_marked == 1 ? mark : has_class ? to_srgb(class_color(own_kind)) : ink, 1);
    }
}
