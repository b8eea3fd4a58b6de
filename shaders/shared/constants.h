// Codes, limits and specialization ids that host, shaders and reference agree on.
#ifndef GEODISK_SHARED_CONSTANTS_H
#define GEODISK_SHARED_CONSTANTS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

// Raised with every change of a record, a push block or the meaning of a constant.
GEODISK_CONST uint kAbi = 17u;

// Where radii vary: proposals of which a candidate takes the first that is kept, or the last.
GEODISK_CONST uint kMostProposals = 1024u;

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
// kCellsPerDistance to the minimum distance or where radii vary as lib/radii.glsl has it, in the
// frame of that edge. A face word packs the first
// cell with the corner the longest edge starts from, or kSingleCell for a face of one cell.
GEODISK_CONST uint kCellsPerDistance = 2u;
GEODISK_CONST uint kFaceCornerShift = 30u;
GEODISK_CONST uint kFirstCellMask = 0x3fffffffu;
GEODISK_CONST uint kSingleCell = 3u;

// What stops a run until the host acts: bits of ControlRec::overflow.
GEODISK_CONST uint kOverflowWindows = 1u;
GEODISK_CONST uint kOverflowVertices = 2u;
GEODISK_CONST uint kOverflowConflicts = 4u;
// Not an overflow but an error: a disk does not end. A window has crossed kLongestChain edges, or the disk
// has, since it trims, pushed kMostWindows and kMostPerVertex for each vertex, of up to kUntrimmedVertices.
GEODISK_CONST uint kOverflowEndless = 8u;
GEODISK_CONST uint kLongestChain = 65536u;
GEODISK_CONST uint kMostWindows = 262144u;
GEODISK_CONST uint kMostPerVertex = 4096u;

// Push::path_rules. No edge has three faces, see split_once() in lib/propagate.glsl.
GEODISK_CONST uint kRuleSplitsOnce = 1u;
// Within a face no way is shorter than the straight one, see turns_back() there.
GEODISK_CONST uint kRuleStraightFaces = 2u;
// A window remembers a face once it has crossed so many edges, a power of two, see turns_back() there: more
// than in disks of real meshes, and too few to widen the guard.
GEODISK_CONST uint kFirstRemembered = 128u;

// Nor this: a disk makes so many windows that they are to be trimmed, or a window has crossed so many edges
// that it is to remember one, by kernels that can.
GEODISK_CONST uint kOverflowTrims = 64u;
// Nor this: the samples' buffer is too small, the set itself is complete.
GEODISK_CONST uint kOverflowSamples = 16u;

// Nor this: a stage has more candidates than the buffers hold.
GEODISK_CONST uint kOverflowCandidates = 32u;

// An order: the stage, counted from the first of the chunk, above the bits of the priority.
GEODISK_CONST uint kPriorityBits = 28u;
GEODISK_CONST uint kMostStages = 15u;     // of a chunk
GEODISK_CONST uint kMostDartStages = 4096u; // of a run that throws darts
GEODISK_CONST uint kAllStages = 0xffffffffu; // where nothing else ends them
GEODISK_CONST uint kNoOrder = 0xffffffffu; // above all orders

// Philox counters of a face: its key, the number of a candidate, the stage, and the proposal. How many
// there are takes this instead of a proposal.
GEODISK_CONST uint kCountProposal = 0xffffffffu;
// Of the seed of a box cell, and of how many candidates it has.
GEODISK_CONST uint kCellSeed = 0xb0c5u;
GEODISK_CONST uint kCountNumber = 0xffffffffu;

// What select goes through.
GEODISK_CONST uint kSelectPool = 0u;    // all candidates, and lists those that come next
GEODISK_CONST uint kSelectList = 1u;    // that list
GEODISK_CONST uint kSelectSettled = 2u; // samples of earlier chunks

// A slot's blocks: one for each candidate before it that conflicts and is not decided.
GEODISK_CONST uint kBlockedForGood = 0x80000000u; // one of them was accepted
GEODISK_CONST uint kClaimed = 0x40000000u;        // some invocation decides it
GEODISK_CONST uint kBlocksMask = 0x3fffffffu;
// Set in its cursor where the rest of its list is left to the next dispatch.
GEODISK_CONST uint kSuspended = 0x80000000u;
// Set in its calls once they are known.
GEODISK_CONST uint kCallsKnown = 0x80000000u;
GEODISK_CONST uint kMostCalls = 0x3fffffffu;

// Where a lane stands.
GEODISK_CONST uint kPhaseIdle = 0u;     // has no slot
GEODISK_CONST uint kPhaseClear = 1u;    // empties the vertex table; cursor is the next row
GEODISK_CONST uint kPhaseSource = 2u;   // spreads over the three edges of the candidate's face
GEODISK_CONST uint kPhasePop = 3u;      // takes the next window or event
GEODISK_CONST uint kPhaseFan = 4u;      // spreads over the corners of a vertex
GEODISK_CONST uint kPhaseCross = 5u;    // carries a window into the next face of its edge
GEODISK_CONST uint kPhaseBlock = 6u;    // the disk is complete; blocks the active ones in it
GEODISK_CONST uint kPhaseComplete = 7u;

// Where a slot stands.
GEODISK_CONST uint kSlotReady = 0u;     // waits for its disk
GEODISK_CONST uint kSlotListed = 1u;    // the disk is complete, and those in it are blocked
GEODISK_CONST uint kSlotDecided = 2u;
GEODISK_CONST uint kSlotCounting = 3u;  // its calls are being counted
GEODISK_CONST uint kSlotCounted = 4u;   // they are in the histogram

// The place of a sample of an earlier chunk, whose disk only rejects.
GEODISK_CONST uint kNoPlace = 0xffffffffu;

// How the operation in flight lies in the frame of its half-edge.
GEODISK_CONST uint kModeInside = 0u;   // the source is in the face, all of it is lit
GEODISK_CONST uint kModeSameWay = 1u;  // a window whose edge runs as the half-edge does
GEODISK_CONST uint kModeOpposite = 2u; // a window whose edge runs against it

// Flags in a half-edge's origin word, above the vertex.
GEODISK_CONST uint kOriginBends = 0x80000000u; // kFanBends of the vertex
GEODISK_CONST uint kManyFaces = 0x40000000u;   // three or more faces share the edge
GEODISK_CONST uint kVertexMask = 0x3fffffffu;

GEODISK_CONST uint kNoHalfEdge = 0xffffffffu;
GEODISK_CONST uint kWholeFan = 0xffffffffu;

// Rows of the vertex table carry the generation of the disk that wrote them, in the two top bits of
// the vertex and of the distance, so that the table is emptied only once in so many disks.
GEODISK_CONST uint kMostGenerations = 15u;
GEODISK_CONST uint kTagShift = 30u;
GEODISK_CONST uint kTagMask = 0xc0000000u;

// The loops of detect: most iterations of each in one trip of the main loop.
GEODISK_CONST uint kMostProbes = 8u;       // rows of the vertex table looked at
GEODISK_CONST uint kCornersPerTrip = 8u;   // of a fan
GEODISK_CONST uint kScanPerTrip = 32u;     // candidates
GEODISK_CONST uint kKeptPerEdge = 4u;      // windows to compare others with, see lib/trim.glsl
// Together: an event taken and two vertices reached, two children left and pushed, kept windows.
GEODISK_CONST uint kIterationsPerTrip = 1u + kCornersPerTrip + 3u * kMostProbes + 6u +
                                        (kKeptPerEdge + 1u) + kScanPerTrip;
// A step: once every few trips a lane that is done takes its next slot.
GEODISK_CONST uint kTripsPerStep = 16u;
GEODISK_CONST uint kClearPerStep = 64u;    // rows of the vertex table
GEODISK_CONST uint kBlocksPerStep = 16u;   // active conflicts of a complete disk
GEODISK_CONST uint kIterationsPerStep =
    1u + kClearPerStep + kBlocksPerStep + kTripsPerStep * kIterationsPerTrip;
// Besides, where events wait in a heap: one taken and two pushed in a trip, each through all levels
// that a heap of the largest capacity has, 2^kMostLevels. Where windows wait there too, two more are.
GEODISK_CONST uint kMostLevels = 26u;
GEODISK_CONST uint kHeapIterationsPerStep = kTripsPerStep * 3u * (kMostLevels + 1u);
GEODISK_CONST uint kTrimIterationsPerStep = kTripsPerStep * 5u * (kMostLevels + 1u);
// Candidates that an invocation of resolve has at hand to decide, and list entries that it goes
// through in one dispatch.
GEODISK_CONST uint kMostAtHand = 8u;
GEODISK_CONST uint kListPerDispatch = 4096u;

// Grids of cells over boxes, at least half a minimum distance wide: a disk reaches kGridReach cells
// to either side of its own, kGridDigits in all. A turn tells which of them are next, a digit of
// kDigitBits for each axis.
GEODISK_CONST uint kMostAxes = 6u;
GEODISK_CONST uint kGridReach = 2u;
GEODISK_CONST uint kGridDigits = 5u;
GEODISK_CONST uint kDigitBits = 3u;
GEODISK_CONST uint kDigitMask = 7u;
// In AxisRec::cells: both ends of the axis are one.
GEODISK_CONST uint kPeriodicAxis = 0x80000000u;
// A trip of grid_detect: cells of a row found, and most candidates tested.
GEODISK_CONST uint kScanPerGridTrip = 16u;
GEODISK_CONST uint kIterationsPerGridTrip =
    1u + 3u * kMostAxes + kGridDigits + kScanPerGridTrip * (1u + kMostAxes);
// Candidates that cause 1, 2, ... calls of the paper's CheckStatus, the last for that many and more.
GEODISK_CONST uint kCallBins = 10u;

// A disk of v vertices begins again, trimming, once it has pushed kUntrimmedWindows + v (kUntrimmedEach +
// 2^-kUntrimmedShift v) windows and events, for v up to kUntrimmedVertices. Disks of real meshes mostly
// make some v sqrt(v).
GEODISK_CONST uint kUntrimmedWindows = 1024u;
GEODISK_CONST uint kUntrimmedEach = 32u;
GEODISK_CONST uint kUntrimmedShift = 2u;
GEODISK_CONST uint kUntrimmedVertices = 65536u;
// Edges whose windows it keeps, a power of two; kKeptPerEdge of each.
GEODISK_CONST uint kKeptEdges = 2048u;
GEODISK_CONST uint kWindowWaits = 0xffffffffu; // in the heap, instead of an event's vertex
GEODISK_CONST uint kNoWindow = 0xffffffffu;

// Rows of a face but its lengths, and of its radii, of a lane record, of a window and of one kept.
GEODISK_CONST uint kFaceRows = 3u;
GEODISK_CONST uint kSpaceRows = 6u; // of a face, where distances go through space
GEODISK_CONST uint kRadiiRows = 2u;
GEODISK_CONST uint kAxisRows = 2u;
GEODISK_CONST uint kPlacedRows = 3u; // of a sample where the caller draws it
GEODISK_CONST uint kPartWords = 8u;  // of a surface among several
GEODISK_CONST uint kLaneRows = 11u;
GEODISK_CONST uint kWindowRows = 2u;
GEODISK_CONST uint kKeptRows = 2u;
// Of a lane, where disks may trim: all windows that it keeps.
GEODISK_CONST uint kTrimRows = kKeptRows * kKeptPerEdge * kKeptEdges;

// Specialization constants.
GEODISK_CONST uint kSpecLocalSize = 0u;
GEODISK_CONST uint kSpecNativeRounding = 1u;
GEODISK_CONST uint kSpecPoolBlock = 2u;
GEODISK_CONST uint kSpecCountedLanes = 3u;
GEODISK_CONST uint kSpecCountCalls = 4u;
GEODISK_CONST uint kSpecDimension = 5u;
GEODISK_CONST uint kSpecCurved = 6u;
GEODISK_CONST uint kSpecAdaptive = 7u; // radii vary
GEODISK_CONST uint kSpecEventHeap = 8u; // vertex events wait in a heap, else in a ring
GEODISK_CONST uint kSpecSeveral = 9u; // surfaces, each with a seed, a density and stages of its own
GEODISK_CONST uint kSpecTrims = 10u;  // disks that make very many windows trim them
GEODISK_CONST uint kSpecManyRows = 11u; // faces have several rows of cells

// Candidates that a work group of the kernels per candidate draws: so many lanes, so many each.
GEODISK_CONST uint kWideLanes = 128u;
GEODISK_CONST uint kDrawPerLane = 16u;
GEODISK_CONST uint kDrawBlock = kWideLanes * kDrawPerLane;
// Of select: few lanes, since most of a group's have no candidate to put into a slot.
GEODISK_CONST uint kSelectLanes = 32u;
GEODISK_CONST uint kSelectBlock = 4096u;
// Places for a range of orders in the list of idle candidates.
GEODISK_CONST uint kListRange = 256u;
// Up to so many slots, batches are filled to the last of them, by one work group that ranks what is
// due; larger ones leave some to spare.
GEODISK_CONST uint kMostRanked = 128u;
// Ranges that the work group goes through at most.
GEODISK_CONST uint kMostRangesRanked = 64u;
GEODISK_CONST uint kMostListed = 0x800000u;

// Words that one work group of the scan covers: so many lanes, so many words each.
GEODISK_CONST uint kScanLanes = 64u;
GEODISK_CONST uint kScanPerLane = 32u;
GEODISK_CONST uint kScanBlock = 2048u;
// Subgroups of a work group whose trips are counted one by one.
GEODISK_CONST uint kMostCountedSubgroups = 256u;
// Sums that a step of the scan over the lanes of a work group adds up.
GEODISK_CONST uint kScanTerms = 8u;

GEODISK_END_SHARED

#endif
