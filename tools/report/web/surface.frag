// The colour of a surface by the exact geodesic distances of the samples that reach the place, and by the
// same which sample a pixel shows.
precision highp float;
precision highp int;
precision highp sampler2D;
#include "records.h"
#include "colors.glsl"

// Textures have 2^kRowBits texels to a row (view.js).
uniform sampler2D faces;   // Two texels each: longest, apex_x, apex_y, base; columns, rows, first_cell.
uniform sampler2D cells;   // Where the windows of each cell begin.
uniform sampler2D windows; // Two texels each: x, y, sigma, sample; the normals left and right.
uniform sampler2D samples; // Radius in units, a part from 0 to 1 for its colour, and its kind.
uniform float cells_per_unit;
uniform float seam;
uniform vec3 light;    // Where it comes from, in the frame of the eye.
uniform int task;      // kPicture, kPick or kArea.
uniform int shown;     // Samples, in dart order.
uniform int marked;    // A sample, or -1.
uniform bool has_disks; // Whether there are any.
uniform bool shows_disks, shows_surface, shows_samples, shows_triangles;
uniform bool by_part; // Colours by each sample's part, else as in pictures.

in vec3 place;
in vec3 facing;
in vec3 weights;
in vec2 in_face;
flat in uint face_index;

out vec4 color;

const int kPicture = 0;
const int kPick = 1;
const int kArea = 2;
const vec3 kChosen = vec3(0.79, 0.34, 0.0); // #e69f00
const float kDot = 0.13; // As in disk_color().
const float kRim = 0.93;

const uint kRowBits = 12u;

ivec2 texel(uint index) {
    return ivec2(index & ((1u << kRowBits) - 1u), index >> kRowBits);
}

#define kSeam seam
FaceRec face_at(uint index) {
    vec4 frame = texelFetch(faces, texel(2u * index), 0);
    vec4 grid = texelFetch(faces, texel(2u * index + 1u), 0);
    return FaceRec(frame.x, frame.y, frame.z, uint(frame.w), cells_per_unit, uint(grid.x),
                   uint(grid.y), uint(grid.z));
}
uint cell_start(uint cell) {
    return uint(texelFetch(cells, texel(cell), 0).x);
}
WindowRec window_at(uint index) {
    vec4 source = texelFetch(windows, texel(2u * index), 0);
    vec4 normals = texelFetch(windows, texel(2u * index + 1u), 0);
    return WindowRec(source.x, source.y, source.z, uint(source.w), normals.x, normals.y, normals.z,
                     normals.w);
}
vec4 sample_at(uint index) {
    return texelFetch(samples, texel(index), 0);
}
float radius_of(uint index) {
    return sample_at(index).x;
}
uint kind_of(uint index) {
    return uint(sample_at(index).z);
}
bool is_shown(uint index) {
    return int(index) < shown;
}
#include "nearest.glsl"

// Within a disk, at so many radii from its centre.
vec3 color_in_disk(float q, uint index) {
    float seen = shows_samples ? q : max(q, kDot);
    if (!by_part) {
        return disk_color(seen, kind_of(index));
    }
    vec3 own = scale_color(sample_at(index).y);
    return seen < kDot ? kMark : seen > kRim ? 0.55 * own : own;
}

// The mean over a pixel, which is `width` radii wide.
vec3 mean_in_disk(float q, float width, uint index) {
    const int kTaps = 5;
    vec3 sum = vec3(0);
    for (int i = 0; i < kTaps; ++i) {
        float at = q + width * ((float(i) + 0.5) / float(kTaps) - 0.5);
        sum += at < 1.0 ? color_in_disk(max(at, 0.0), index) : kBare;
    }
    return sum / float(kTaps);
}

vec4 number_color(uint number) {
    uvec3 bytes = uvec3(number, number >> 8u, number >> 16u) & 255u;
    return vec4(vec3(bytes) / 255.0, 1);
}

void main() {
    vec3 to_eye = normalize(-place);
    // A surface may be seen from either side.
    float size = length(facing);
    vec3 up = size > 0.0 ? facing / size : to_eye;
    float tilt = dot(up, to_eye);
    up = tilt < 0.0 ? -up : up;
    if (task == kArea) {
        color = vec4(vec3(min(1.0 / abs(tilt), float(kMaxTilt)) / float(kMaxTilt)), 1);
        return;
    }
    // Width of a pixel, in units.
    float width = 0.5 * (length(dFdx(in_face)) + length(dFdy(in_face)));
    vec3 change = fwidth(weights);
    Nearest nearest = kNoNearest;
    if (has_disks && shows_disks) {
        float density;
        nearest = look_up(face_index, in_face, density);
    }
    bool is_in_disk = nearest.first < 1.0;
    if (task == kPick) {
        color = number_color(is_in_disk ? nearest.sample_index + 1u : 0u);
        return;
    }
    if (!is_in_disk && !shows_surface) {
        discard;
    }
    vec3 matte = kBare;
    if (is_in_disk) {
        uint index = nearest.sample_index;
        matte = nearest.overlaps ? kOverlap
                                 : mean_in_disk(nearest.first, width / radius_of(index), index);
        if (int(index) == marked) {
            matte = mix(matte, kChosen, 0.85);
        }
    }
    if (shows_triangles) {
        vec3 lines = weights / change;
        float line = min(lines.x, min(lines.y, lines.z));
        // Hardly to be seen where they would be closer than some pixels.
        float extent = 1.0 / max(change.x, max(change.y, change.z));
        matte *= mix(1.0, mix(0.55, 1.0, smoothstep(0.4, 1.2, line)), clamp(extent / 8.0, 0.25, 1.0));
    }
    color = vec4(to_srgb(shade(matte, up, to_eye, light)), 1);
}
