// Binding numbers, one per buffer and the same in every kernel; all live in set 0. A kernel declares
// only what it touches, never more than eight storage buffers.
#ifndef GEODISK_SHARED_BINDINGS_H
#define GEODISK_SHARED_BINDINGS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

GEODISK_CONST uint kBindFaces = 0u;      // per face three rows of HalfEdgeRec; then one of FaceLengthsRec each;
                                         // where distances go through space, a row per corner with
                                         // its coordinates in multiples of 2^-32 of the bounding
                                         // box, then one with its normal; behind the coordinates of
                                         // the first the area, of the second the key
GEODISK_CONST uint kBindFans = 1u;       // a row of FanRec per vertex; then the fans' corners, pairs of
                                         // half-edge and angles; then the angles by half-edge;
                                         // where radii vary, RadiiRec per face
GEODISK_CONST uint kBindAxes = kBindFans; // of grids in space: two rows of AxisRec per axis
GEODISK_CONST uint kBindKeys = 2u;       // a word per face, where the caller gives keys; of several
                                         // surfaces always, then a word per face, which of them it
                                         // is of, and PartRec each
GEODISK_CONST uint kBindCells = 3u;      // the place where each cell's candidates start, and one past
                                         // the last. Of a mesh whose faces are all of one cell that
                                         // is kBindStarts.
GEODISK_CONST uint kBindStates = 4u;     // two bits per candidate, by place: its state; on surfaces
                                         // then a word each, the weight of its face's second corner
GEODISK_CONST uint kBindWeights = 5u;    // likewise the weight of the third corner, in units of 2^-24
GEODISK_CONST uint kBindPoints = kBindWeights; // the same: coordinates of the candidates, by place,
                                         // axis after axis; where lengths of curves are taken, then
                                         // those of the normals; then the number it was drawn by
GEODISK_CONST uint kBindOrders = 6u;     // a word per candidate, by place: its stage in the chunk and
                                         // its priority; of an active one its slot
GEODISK_CONST uint kBindStarts = 7u;     // for each face or box cell, stage by stage, the number of
                                         // candidates drawn before, and the number of all
GEODISK_CONST uint kBindPool = 8u;       // a slice per lane: LaneRec, windows, events, vertex table;
                                         // then a list of conflicts per slot
GEODISK_CONST uint kBindControl = 9u;    // ControlRec, then SlotRec per slot of an active candidate
GEODISK_CONST uint kBindList = 10u;      // candidates that come next: for each range of orders how many
                                         // there are, then kListRange places
GEODISK_CONST uint kBindSums = 11u;      // block sums of the scans
GEODISK_CONST uint kBindSamples = 12u;   // SampleRec per accepted candidate, in dart order
GEODISK_CONST uint kBindAccepted = 13u;  // the same as they were accepted
GEODISK_CONST uint kBindBuckets = 14u;   // while samples are put in order: where the samples of each
                                         // range of orders start; then the samples by range
// Buffers a second time, as texel buffers, see lib/buffers.glsl.
GEODISK_CONST uint kBindPoolTexels = 15u;
GEODISK_CONST uint kBindStatesTexels = 16u;
GEODISK_CONST uint kBindOrdersTexels = 17u;
GEODISK_CONST uint kBindCellsTexels = 18u;
// Of the caller alone.
GEODISK_CONST uint kBindVertices = 19u;  // floats
GEODISK_CONST uint kBindIndices = 20u;   // three of 16 or 32 bits per face
GEODISK_CONST uint kBindPlaced = 21u;    // PlacedRec per sample
GEODISK_CONST uint kBindArguments = 22u; // of an indirect draw: four words
GEODISK_CONST uint kBindCount = 23u;

GEODISK_END_SHARED

#endif
