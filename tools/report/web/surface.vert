// A corner of a face, drawn without indices, as in tools/picture/shaders/surface.vert.
precision highp float;
precision highp int;

uniform mat4 modelViewMatrix, projectionMatrix;

in vec3 position;
in vec3 normal;
in vec2 in_frame;

out vec3 place; // In the frame of the eye, as the normal.
out vec3 facing;
out vec3 weights; // Of the corners of the face.
out vec2 in_face; // In the frame of the face, as windows are.
flat out uint face_index;

void main() {
    uint corner = uint(gl_VertexID);
    face_index = corner / 3u;
    uint which = corner % 3u;
    in_face = in_frame;
    weights = vec3(which == 0u, which == 1u, which == 2u);
    vec4 at = modelViewMatrix * vec4(position, 1);
    place = at.xyz;
    facing = mat3(modelViewMatrix) * normal;
    gl_Position = projectionMatrix * at;
}
