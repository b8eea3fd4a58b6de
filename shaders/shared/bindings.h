// Binding numbers, one per buffer, the same in every kernel; all live in set 0. A kernel declares
// only what it touches, never more than eight.
#ifndef GEODISK_SHARED_BINDINGS_H
#define GEODISK_SHARED_BINDINGS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

GEODISK_CONST uint kBindFaces = 0u;      // per face three rows of HalfEdgeRec and one of FaceLinksRec
GEODISK_CONST uint kBindFans = 1u;       // a row of FanRec per vertex; then the fans' corners, pairs of
                                         // half-edge and angles; then the angles by half-edge
GEODISK_CONST uint kBindAlias = 2u;      // AliasRec per face
GEODISK_CONST uint kBindCells = 3u;      // the place where each cell's candidates start, and one past
                                         // the last
GEODISK_CONST uint kBindPoints = 4u;     // PointRec per candidate, sorted by cell
GEODISK_CONST uint kBindPlaces = 5u;     // rank -> place in the sorted order
GEODISK_CONST uint kBindSlots = 6u;      // SlotRec per slot of an active candidate
GEODISK_CONST uint kBindPool = 7u;       // one slice of rows per slot: heap, windows, table, list
GEODISK_CONST uint kBindControl = 8u;    // ControlRec, then a blocker word per slot
GEODISK_CONST uint kBindMarks = 9u;      // a word per candidate. In the rounds: the slot of an active
                                         // one, by place; in the end: 1 where accepted, then its
                                         // output place, by rank
GEODISK_CONST uint kBindSums = 10u;      // block sums of the scans; in the rounds: idle ranks as bits
GEODISK_CONST uint kBindSamples = 11u;   // SampleRec per accepted candidate, in rank order
GEODISK_CONST uint kBindCount = 12u;

GEODISK_END_SHARED

#endif
