// Binding numbers, one per buffer, the same in every kernel; all live in set 0. A kernel declares
// only what it touches, never more than eight.
#ifndef GEODISK_SHARED_BINDINGS_H
#define GEODISK_SHARED_BINDINGS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

GEODISK_CONST uint kBindHalfEdges = 0u;  // two rows of HalfEdgeRec per half-edge
GEODISK_CONST uint kBindFans = 1u;       // a row of FanRec per vertex, then corners, four to a row
GEODISK_CONST uint kBindAlias = 2u;      // AliasRec per face
GEODISK_CONST uint kBindCells = 3u;      // a word per face (first cell, grid corner), then the place
                                         // where each cell's candidates start, and one past the last
GEODISK_CONST uint kBindPoints = 4u;     // PointRec per candidate, sorted by cell
GEODISK_CONST uint kBindStates = 5u;     // state word per candidate, sorted by cell
GEODISK_CONST uint kBindPlaces = 6u;     // rank -> place in the sorted order
GEODISK_CONST uint kBindSlots = 7u;      // SlotRec per slot of an active candidate
GEODISK_CONST uint kBindPool = 8u;       // one slice of rows per slot: heap, windows, table, list
GEODISK_CONST uint kBindControl = 9u;    // ControlRec, then a blocker word per slot
GEODISK_CONST uint kBindMarks = 10u;     // a word per candidate: 1 where accepted, then its output place
GEODISK_CONST uint kBindSums = 11u;      // block sums of the scans
GEODISK_CONST uint kBindSamples = 12u;   // SampleRec per accepted candidate, in rank order
GEODISK_CONST uint kBindCount = 13u;

GEODISK_END_SHARED

#endif
