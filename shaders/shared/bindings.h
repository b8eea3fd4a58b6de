// Binding numbers, one per buffer and the same in every kernel; all live in set 0. A kernel declares
// only what it touches, never more than eight storage buffers.
#ifndef GEODISK_SHARED_BINDINGS_H
#define GEODISK_SHARED_BINDINGS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

GEODISK_CONST uint kBindFaces = 0u;      // per face three rows of HalfEdgeRec and one of FaceLinksRec
                                         // where distances go through space, a row per corner with
                                         // its coordinates in multiples of 2^-32 of the bounding
                                         // box, then one with its normal
GEODISK_CONST uint kBindFans = 1u;       // a row of FanRec per vertex; then the fans' corners, pairs of
                                         // half-edge and angles; then the angles by half-edge;
                                         // where radii vary, RadiiRec per face
GEODISK_CONST uint kBindAxes = kBindFans; // of grids in space: AxisRec per axis
GEODISK_CONST uint kBindAlias = 2u;      // AliasRec per face
GEODISK_CONST uint kBindCells = 3u;      // the place where each cell's candidates start, and one past
                                         // the last
GEODISK_CONST uint kBindStates = 4u;     // a word per candidate, sorted by cell: its state and the
                                         // weight of its face's second corner
GEODISK_CONST uint kBindWeights = 5u;    // likewise the weight of the third corner, in units of 2^-24;
                                         // while binning, the rank
GEODISK_CONST uint kBindPoints = kBindWeights; // the same: coordinates of the candidates, sorted by
                                         // cell, axis after axis; where lengths of curves are taken,
                                         // then those of the normals
GEODISK_CONST uint kBindPlaces = 6u;     // rank -> place in the sorted order
GEODISK_CONST uint kBindSlots = 7u;      // SlotRec per slot of an active candidate
GEODISK_CONST uint kBindPool = 8u;       // a slice per lane: LaneRec, windows, events, vertex table;
                                         // then a list of conflicts per slot
GEODISK_CONST uint kBindControl = 9u;    // ControlRec, then a blocker word per slot
GEODISK_CONST uint kBindMarks = 10u;     // a word per candidate. While binning: its number in its cell,
                                         // by rank; in the rounds: the slot of an active one, by
                                         // place; in the end: 1 where accepted, then its output
                                         // place, by rank
GEODISK_CONST uint kBindSums = 11u;      // block sums of the scans; in the rounds: idle ranks as bits
GEODISK_CONST uint kBindSamples = 12u;   // SampleRec per accepted candidate, in rank order
// The pool a second time, as a texel buffer, see lib/buffers.glsl.
GEODISK_CONST uint kBindPoolTexels = 13u;
GEODISK_CONST uint kBindCount = 14u;

GEODISK_END_SHARED

#endif
