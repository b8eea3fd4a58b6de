// Results of a run: the only header for users' shaders. In GLSL all its names begin with Geodisk or
// GEODISK; names of the other headers belong to the kernels.
#ifndef GEODISK_SHARED_SAMPLES_H
#define GEODISK_SHARED_SAMPLES_H

#include "abi.h"

#ifndef __cplusplus
#define SampleRec GeodiskSampleRec
#define PlacedRec GeodiskPlacedRec
#endif

GEODISK_BEGIN_SHARED

// An accepted candidate. The weights are multiples of 2^-24, and the weight of the first corner is exactly
// 1 - weight1 - weight2. With classes the lowest three bits of the order are the class. In boxes the words after the order are the cell it was drawn in, its number there,
// and its stage.
struct SampleRec {
    uint order; uint face; float weight1; float weight2;
};

// A sample for drawing: its position, and its radius in the same units; its normal, of length 1, or 0 on a
// face without one; its face, in its own surface; the weights of its second and third corner; its surface,
// of several; its order in the job.
struct PlacedRec {
    float x; float y; float z; float radius;
    float normal_x; float normal_y; float normal_z; uint face;
    float weight1; float weight2; uint part; uint order;
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(SampleRec) == 16 && offsetof(SampleRec, weight2) == 12);
static_assert(sizeof(PlacedRec) == 48 && offsetof(PlacedRec, order) == 44);
} // namespace geodisk::gpu
#else
#undef SampleRec
#undef PlacedRec
#endif

#endif
