// Codes, limits and specialization ids that host, shaders and reference agree on.
#ifndef GEODISK_SHARED_CONSTANTS_H
#define GEODISK_SHARED_CONSTANTS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

// State of a candidate: the two low bits of its state word. The higher bits of an active one name
// the slot that works on it.
GEODISK_CONST uint kIdle = 0u;
GEODISK_CONST uint kActive = 1u;
GEODISK_CONST uint kAccepted = 2u;
GEODISK_CONST uint kRejected = 3u;
GEODISK_CONST uint kStateMask = 3u;
GEODISK_CONST uint kStateSlotShift = 2u;

// Angles around a vertex are integers in units of 2^-13 radian, so that comparing them is exact
// everywhere. A corner's word holds its start in the low half and its size in the high half.
GEODISK_CONST uint kAnglePi = 25736u;         // pi * 2^13
GEODISK_CONST uint kAngleTolerance = 8u;      // 2^-10 radian
GEODISK_CONST uint kLargestFanAngle = 65535u; // wider fans count as irregular

// Flags of a vertex fan.
GEODISK_CONST uint kFanBends = 1u;     // the angle sum allows a shortest path to bend here
GEODISK_CONST uint kFanOpen = 2u;      // the fan starts and ends on a border
GEODISK_CONST uint kFanIrregular = 4u; // no rotational order: several fans or non-manifold edges

// Cells: a face whose longest edge exceeds one cell holds its candidates in a grid of square cells,
// kCellsPerDistance to the minimum distance, in the frame of that edge. A face word packs the first
// cell with the corner the longest edge starts from, or kSingleCell for a face of one cell.
GEODISK_CONST uint kCellsPerDistance = 2u;
GEODISK_CONST uint kFaceCornerShift = 30u;
GEODISK_CONST uint kFirstCellMask = 0x3fffffffu;
GEODISK_CONST uint kSingleCell = 3u;

// What stops a run until the host acts: bits of ControlRec::overflow.
GEODISK_CONST uint kOverflowWindows = 1u;
GEODISK_CONST uint kOverflowVertices = 2u;
GEODISK_CONST uint kOverflowConflicts = 4u;
// Not an overflow but an error: a window has crossed kLongestChain edges, which no disk needs.
GEODISK_CONST uint kOverflowChain = 8u;
GEODISK_CONST uint kLongestChain = 65536u;

// Set in a heap record's first word when it is the event of a vertex and not a window.
GEODISK_CONST uint kVertexEvent = 0x80000000u;
// Set in a blocker word once an accepted candidate of lower rank conflicts.
GEODISK_CONST uint kBlockedForGood = 0x80000000u;

// Where a slot stands.
GEODISK_CONST uint kPhaseClear = 0u;   // empties the vertex table; cursor is the next row
GEODISK_CONST uint kPhaseSource = 1u;  // spreads over the three edges of the candidate's face
GEODISK_CONST uint kPhasePop = 2u;     // takes the nearest window or vertex
GEODISK_CONST uint kPhaseFan = 3u;     // spreads over the corners of a vertex
GEODISK_CONST uint kPhaseCross = 4u;   // carries a window into every other face of its edge
GEODISK_CONST uint kPhaseDone = 5u;    // the disk is complete
GEODISK_CONST uint kPhaseStuck = 6u;   // the slice overflowed

// How the operation in flight lies in the frame of its half-edge.
GEODISK_CONST uint kModeInside = 0u;   // the source is in the face, all of it is lit
GEODISK_CONST uint kModeSameWay = 1u;  // a window whose edge runs as the half-edge does
GEODISK_CONST uint kModeOpposite = 2u; // a window whose edge runs against it

// Set in a half-edge's origin word where no other face shares the edge.
GEODISK_CONST uint kBorder = 0x80000000u;

GEODISK_CONST uint kNoHalfEdge = 0xffffffffu;
GEODISK_CONST uint kWholeFan = 0xffffffffu;

// Rows of a slot record and of a window.
GEODISK_CONST uint kSlotRows = 9u;
GEODISK_CONST uint kWindowRows = 2u;

// Specialization constants.
GEODISK_CONST uint kSpecLocalSize = 0u;
GEODISK_CONST uint kSpecNativeRounding = 1u;

// Elements one work group of the scan covers, and with them the limit of what can be scanned:
// kScanBlock squared.
GEODISK_CONST uint kScanLanes = 128u;
GEODISK_CONST uint kScanPerLane = 32u;
GEODISK_CONST uint kScanBlock = 4096u;

GEODISK_END_SHARED

#endif
