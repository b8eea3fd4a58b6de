// A corner of a face, drawn without indices: where it lies in the picture, in the scene, and in the
// frame of its face.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "picture_records.h"

layout(std430, set = 0, binding = 0) readonly buffer Corners { CornerRec corners[]; };
layout(std430, set = 0, binding = 1) readonly buffer Faces { FaceRec faces[]; };
layout(push_constant, std430) uniform Push { mat4 to_clip; };

layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 in_face;
layout(location = 3) flat out uint face_index;
layout(location = 4) out float value;

invariant gl_Position;

void main() {
    const uint corner = uint(gl_VertexIndex);
    const CornerRec at = corners[corner];
    face_index = corner / 3u;
    const FaceRec face = faces[face_index];
    const uint from_base = (corner % 3u + 3u - face.base) % 3u;
    in_face = from_base == 0u   ? vec2(0)
              : from_base == 1u ? vec2(face.longest, 0)
                                : vec2(face.apex_x, face.apex_y);
    place = vec3(at.x, at.y, at.z);
    normal = vec3(at.normal_x, at.normal_y, at.normal_z);
    value = at.value;
    gl_Position = to_clip * vec4(place, 1);
}
