// Records that the shaders of pictures read, the same in C++ and GLSL: four-byte scalars alone, so
// that std430 offsets are 0, 4, 8, ... in both.
#ifndef GEODISK_PICTURE_RECORDS_H
#define GEODISK_PICTURE_RECORDS_H

#ifdef __cplusplus
#include <cstdint>
namespace geodisk::tools::picture {
using uint = std::uint32_t;
#define GEODISK_PICTURE_CONSTANT constexpr uint
#else
#define GEODISK_PICTURE_CONSTANT const uint
#endif

// Subjects that a pipeline draws, its specialization constant 0.
GEODISK_PICTURE_CONSTANT kDrawDisks = 0u;
GEODISK_PICTURE_CONSTANT kDrawPoints = 1u;
GEODISK_PICTURE_CONSTANT kDrawVoronoi = 2u;
GEODISK_PICTURE_CONSTANT kDrawDistance = 3u;
GEODISK_PICTURE_CONSTANT kDrawDensity = 4u;
// Amount of surface behind each pixel, in kMaxTilt-th parts of what a pixel shows of a surface that
// faces it.
GEODISK_PICTURE_CONSTANT kDrawArea = 5u;
GEODISK_PICTURE_CONSTANT kMaxTilt = 5u;
// Width of the borders of cells, as parts of a radius.
GEODISK_PICTURE_CONSTANT kBordersPerRadius = 20u;
// The edges of a box, beside balls.
GEODISK_PICTURE_CONSTANT kDrawFrame = 6u;
// The values of corners, by colour and by lines where they are equal.
GEODISK_PICTURE_CONSTANT kDrawValues = 7u;

// A corner of a drawn face: where it lies in the scene, its normal there, and its value, negative
// where it has none.
struct CornerRec {
    float x; float y; float z;
    float normal_x; float normal_y; float normal_z;
    float value;
};

// A face in the frame of its half-edge `base`: corner base at (0, 0), the next one at (longest, 0),
// the third at the apex. Windows are listed by square cells, so many to the unit of length, row by
// row.
struct FaceRec {
    float longest; float apex_x; float apex_y; uint base;
    float cells_per_unit; uint columns; uint rows; uint first_cell;
};

// View that a sample has of a face: its place (x, y) unfolded into the frame of the face, or that
// of a pseudo-source at a distance of sigma from it. It sees the points p with left . (p - source)
// and right . (p - source) of at least 0; these are of length 1, or 0 where all of the face is
// seen.
struct WindowRec {
    float x; float y; float sigma; uint sample_index;
    float left_x; float left_y; float right_x; float right_y;
};

// A sample: its radius in units of length, a number for its colour, and its kind: 1 + its class, or 0
// without classes.
struct SampleRec {
    float radius; uint color; uint kind;
};

// A sample in a box of three dimensions, in the scene.
struct BallRec {
    float x; float y; float z; float radius; uint color;
};

// Values that change from draw to draw.
struct PushRec {
    float to_clip[16];   // column by column
    float eye_x; float eye_y; float eye_z; // in the scene
    float light_x; float light_y; float light_z; // the direction it comes from
    float high; // the end of the scale: a point's radius in radii, a density, or a value
    uint cuts;  // not 0: without the eighth of the box nearest to the eye
};

#ifdef __cplusplus
static_assert(sizeof(CornerRec) == 28 && sizeof(FaceRec) == 32 && sizeof(WindowRec) == 32 &&
              sizeof(SampleRec) == 12 && sizeof(BallRec) == 20 && sizeof(PushRec) == 96);
}
#endif
#endif
