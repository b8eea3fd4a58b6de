// A sample as a point, of some pixels.
precision highp float;
precision highp int;

uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pixel;   // Width of a pixel at a distance of 1.
uniform float spacing; // Of samples, about.
uniform float most;    // Width of a point, in pixels.
uniform int marked;

in vec3 position;

flat out uint number;
flat out int is_marked;

void main() {
    number = uint(gl_VertexID);
    is_marked = gl_VertexID == marked ? 1 : 0;
    vec4 at = modelViewMatrix * vec4(position, 1);
    float own_pixel = pixel * -at.z;
    gl_PointSize = is_marked == 1 ? 2.5 * most : clamp(0.3 * spacing / own_pixel, 1.0, most);
    // Not half within the surface.
    at.xyz *= 1.0 - 2.0 * own_pixel / length(at.xyz);
    gl_Position = projectionMatrix * at;
}
