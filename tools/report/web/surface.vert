// A corner of a face, drawn without indices, as in tools/picture/shaders/surface.vert.
#include "head.glsl"

uniform mat4 modelViewMatrix, projectionMatrix;
uniform bool has_disks;

in vec3 position;
in vec3 normal;

out vec3 place; // In the frame of the eye, as the normal.
out vec3 facing;
out vec3 weights; // Of the corners of the face.
out vec2 in_face;
flat out uint face_index;

void main() {
    uint corner = uint(gl_VertexID);
    face_index = corner / 3u;
    uint which = corner % 3u;
    weights = vec3(which == 0u, which == 1u, which == 2u);
    in_face = vec2(0);
    if (has_disks) {
        vec4 frame = texelFetch(faces, texel(2u * face_index), 0);
        uint from_base = (which + 3u - uint(frame.w)) % 3u;
        in_face = from_base == 0u ? vec2(0) : from_base == 1u ? vec2(frame.x, 0) : frame.yz;
    }
    vec4 at = modelViewMatrix * vec4(position, 1);
    place = at.xyz;
    facing = mat3(modelViewMatrix) * normal;
    gl_Position = projectionMatrix * at;
}
