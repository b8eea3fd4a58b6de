// A sample as a point, of some pixels.
precision highp float;
precision highp int;

uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pixel;   // Width of a pixel at a distance of 1.
uniform float spacing; // Of samples, about.
uniform float most;    // Width of a point, in pixels.
uniform int marked;

in vec3 position;
in vec3 normal;
in float kind;

flat out uint number;
flat out int is_marked;
flat out uint own_kind;

void main() {
    number = uint(gl_VertexID);
    own_kind = uint(kind);
    is_marked = gl_VertexID == marked ? 1 : 0;
    vec4 at = modelViewMatrix * vec4(position, 1);
    float own_pixel = pixel * -at.z;
    // Small beside its disk, and where the surface turns away.
    float facing = abs(dot(mat3(modelViewMatrix) * normal, normalize(at.xyz)));
    float width = clamp(0.22 * spacing / own_pixel, 1.0, most) * mix(0.4, 1.0, facing);
    gl_PointSize = is_marked == 1 ? 2.5 * most : max(width, 1.0);
    // Not half within the surface, nor in sight from behind it.
    float before = is_marked == 1 ? gl_PointSize : 1.0;
    at.xyz *= 1.0 - before * own_pixel / length(at.xyz);
    gl_Position = projectionMatrix * at;
}
