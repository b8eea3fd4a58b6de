// Codes, limits and specialization ids that host, shaders and reference agree on.
#ifndef GEODISK_SHARED_CONSTANTS_H
#define GEODISK_SHARED_CONSTANTS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

// Raised with every change of a record, a push block or the meaning of a constant.
GEODISK_CONST uint kAbi = 25u;

// If radii vary: maximum of proposals per candidate. It takes the first that is kept, or the last.
GEODISK_CONST uint kMaxProposals = 1024u;

// Angles around a vertex are integers in units of 2^-13 radian, so that comparing them is exact
// everywhere. A corner's word holds its start in the low half and its size in the high half, with
// kCornerTurned if the fan turns from the previous half-edge of the face to that of the corner.
GEODISK_CONST uint kCornerTurned = 0x80000000u;
GEODISK_CONST uint kAnglePi = 25736u;         // pi * 2^13
GEODISK_CONST uint kAngleTolerance = 8u;      // 2^-10 radian
GEODISK_CONST uint kLargestFanAngle = 65535u; // wider fans count as irregular
GEODISK_CONST uint kFarAngle = 1048576u;      // beyond all angles

// Arrival of a path at a vertex through a corner, see lib/shadow.glsl: the angle from the corner's
// half-edge in units of 2^-11 radian, above kBlurBits that tell its error. It is in the word of the
// path's chain, below that.
GEODISK_CONST uint kBlurBits = 2u;
GEODISK_CONST uint kMaxBlur = 3u; // the angle is not known
GEODISK_CONST uint kArrivedAlongPrevious = 0x7ffcu; // along the other edge of the corner
GEODISK_CONST uint kChainShift = 15u;
GEODISK_CONST uint kArrivalMask = 0x7fffu;

// Flags of a vertex fan.
GEODISK_CONST uint kFanBends = 1u;     // the angle sum allows a shortest path to bend here
GEODISK_CONST uint kFanOpen = 2u;      // the fan starts and ends on a border
GEODISK_CONST uint kFanIrregular = 4u; // no rotational order: several fans or non-manifold edges

// Cells: a face whose longest edge exceeds one cell holds its candidates in a grid of square cells, in the
// frame of that edge. There are kCellsPerDistance cells per minimum distance; if radii vary, see
// lib/radii.glsl. The cell word of a face packs its first cell and the corner where the longest edge
// starts, or kSingleCell for a face with one cell.
GEODISK_CONST uint kCellsPerDistance = 2u;
GEODISK_CONST uint kFaceCornerShift = 30u;
GEODISK_CONST uint kFirstCellMask = 0x3fffffffu;
GEODISK_CONST uint kSingleCell = 3u;

// Reasons that stop a run until the host acts: bits of ControlRec::overflow.
GEODISK_CONST uint kOverflowWindows = 1u;
GEODISK_CONST uint kOverflowVertices = 2u;
GEODISK_CONST uint kOverflowConflicts = 4u;
// An error: the disk of a sample does not end. A window has crossed kLongestChain edges, or the disk, since it trims, has
// pushed kMaxWindows and kMaxPerVertex for each vertex, of up to kUntrimmedVertices.
GEODISK_CONST uint kOverflowEndless = 8u;
GEODISK_CONST uint kLongestChain = 65536u;
GEODISK_CONST uint kMaxWindows = 262144u;
GEODISK_CONST uint kMaxPerVertex = 4096u;
// Stands for the longest chain of a disk that does not end.
GEODISK_CONST uint kEndless = 0xffffffffu;

// Bits of Push::path_rules. No edge has three faces, see split_once() in lib/propagate.glsl.
GEODISK_CONST uint kRuleSplitsOnce = 1u;
// Within a face no path is shorter than the straight one, see turns_back() there.
GEODISK_CONST uint kRuleStraightFaces = 2u;
// Another settled sample is as near to each vertex as its bound, see bound_of() there.
GEODISK_CONST uint kRuleBounded = 4u;
// Number of crossed edges, a power of two, from which a window remembers a face, see turns_back() there. It
// is more than in disks of real meshes, and too small to widen the guard.
GEODISK_CONST uint kFirstRemembered = 128u;

// A disk has so many windows that it needs a work group or must trim them, or a window has crossed so many
// edges that it must remember one. Needs kernels that can.
GEODISK_CONST uint kOverflowTrims = 64u;
// By how much kOverflowWindows and kOverflowVertices are shifted for the slices of work groups, where lanes
// have others.
GEODISK_CONST uint kOverflowLargeShift = 7u;
// The buffer of samples is too small.
GEODISK_CONST uint kOverflowSamples = 16u;

// A stage has more candidates than the buffers hold.
GEODISK_CONST uint kOverflowCandidates = 32u;

// Order: the stage, counted from the first of the chunk, above the bits of the priority.
GEODISK_CONST uint kPriorityBits = 28u;
GEODISK_CONST uint kMaxStages = 15u;     // maximum of stages of a chunk
GEODISK_CONST uint kMaxDartStages = 4096u; // maximum of stages of darts
GEODISK_CONST uint kAllStages = 0xffffffffu; // no limit of stages
GEODISK_CONST uint kNoOrder = 0xffffffffu; // above all orders

// Philox counter of a face: its key, the number of a candidate, the stage, and the proposal. The number of
// candidates uses this instead of a proposal.
GEODISK_CONST uint kCountProposal = 0xffffffffu;
// Philox counters for the seed of a box cell, and for its number of candidates.
GEODISK_CONST uint kCellSeed = 0xb0c5u;
GEODISK_CONST uint kCountNumber = 0xffffffffu;

// Bit of the face of a settled sample: it is a point to avoid, and its order is the word of its radius, in
// units of the minimum distance. If it keeps out a single class, the bits above the two weights say which, from
// kKeptClassShift on: those of weight1 the higher two bits, those of weight2 the lower two of the class + 1.
GEODISK_CONST uint kKeepsOut = 0x80000000u;
GEODISK_CONST uint kKeptClassShift = 30u;

// Classes of candidates. The lowest bits of an order are the class, and the bits of a candidate's first
// weight word from kClassShift on.
GEODISK_CONST uint kMaxClasses = 8u;
GEODISK_CONST uint kClassMask = 7u;
GEODISK_CONST uint kClassShift = 28u;
GEODISK_CONST uint kNoDart = 0x80000000u; // bit of that word: no dart, see kClassShares
// Words of the table of classes: for each class the highest random word of it and those before it; for each
// pair its distance; for each class its largest distance; the cells per unit of length; the number of classes
// with shares, 0 or all; for each class what its priorities are multiplied by, in units of 2^-31. Lengths are
// in units of the minimum distance. From kClassWords on the shares of all faces, a word for each class: that
// of each corner in ten bits, in units of 1 / kWholeShare.
GEODISK_CONST uint kClassDistances = 8u;
GEODISK_CONST uint kClassReaches = 72u;
GEODISK_CONST uint kClassCells = 80u;
GEODISK_CONST uint kClassShares = 81u;
GEODISK_CONST uint kClassTurns = 84u;
GEODISK_CONST uint kClassWords = 92u; // whole rows
GEODISK_CONST uint kShareBits = 10u;
GEODISK_CONST uint kWholeShare = 512u;

// Modes of select.
GEODISK_CONST uint kSelectPool = 0u;    // visits all candidates, and lists those that come next
GEODISK_CONST uint kSelectList = 1u;    // visits that list
GEODISK_CONST uint kSelectSettled = 2u; // visits samples of earlier chunks

// Blocks of a slot: one per undecided candidate before it that conflicts.
GEODISK_CONST uint kBlockedForGood = 0x80000000u; // one of them was accepted
GEODISK_CONST uint kClaimed = 0x40000000u;        // an invocation is deciding it
GEODISK_CONST uint kBlocksMask = 0x3fffffffu;
// Set in its cursor if the rest of its list is left to the next dispatch.
GEODISK_CONST uint kSuspended = 0x80000000u;

// Phases of a lane.
GEODISK_CONST uint kPhaseIdle = 0u;     // has no slot
GEODISK_CONST uint kPhaseClear = 1u;    // empties the vertex table; cursor is the next row
GEODISK_CONST uint kPhaseSource = 2u;   // spreads over the three edges of the candidate's face
GEODISK_CONST uint kPhasePop = 3u;      // takes the next window or event
GEODISK_CONST uint kPhaseFan = 4u;      // spreads over the corners of a vertex
GEODISK_CONST uint kPhaseCross = 5u;    // carries a window into the next face of its edge
GEODISK_CONST uint kPhaseBlock = 6u;    // the disk is complete; adds blocks to the active ones in it
GEODISK_CONST uint kPhaseComplete = 7u;

// Phases of a work group that computes a disk in waves; `cursor` of its record is the next of what the
// phase goes through.
GEODISK_CONST uint kGroupIdle = 0u;    // has no slot
GEODISK_CONST uint kGroupSource = 1u;  // windows of the candidate
GEODISK_CONST uint kGroupSort = 2u;    // windows: lists those of the wave
GEODISK_CONST uint kGroupPropose = 3u; // windows of the wave: proposes the distances of vertices
GEODISK_CONST uint kGroupScan = 4u;    // scans: tests candidates
GEODISK_CONST uint kGroupSettle = 5u;  // proposals: keeps the shortest, makes events
GEODISK_CONST uint kGroupSpread = 6u;  // windows of the wave: makes those of the next
GEODISK_CONST uint kGroupLight = 7u;   // events: lights the fans of vertices
GEODISK_CONST uint kGroupNextWave = 8u;
GEODISK_CONST uint kGroupBlock = 9u;   // active conflicts: adds blocks
GEODISK_CONST uint kGroupClear = 10u;  // vertices of the table
GEODISK_CONST uint kGroupComplete = 11u;

// Phases of a slot.
GEODISK_CONST uint kSlotReady = 0u;     // waits for its disk
GEODISK_CONST uint kSlotListed = 1u;    // the disk is complete, and the active ones in it have blocks
GEODISK_CONST uint kSlotDecided = 2u;

// Place of a sample of an earlier chunk, whose disk only rejects.
GEODISK_CONST uint kNoPlace = 0xffffffffu;

// Position of the operation in flight in the frame of its half-edge.
GEODISK_CONST uint kModeInside = 0u;   // the source is in the face, which is lit completely
GEODISK_CONST uint kModeSameWay = 1u;  // a window whose edge has the direction of the half-edge
GEODISK_CONST uint kModeOpposite = 2u; // a window whose edge has the opposite direction

// Flags in a half-edge's origin word, above the vertex.
GEODISK_CONST uint kOriginBends = 0x80000000u; // kFanBends of the vertex
GEODISK_CONST uint kManyFaces = 0x40000000u;   // three or more faces share the edge
GEODISK_CONST uint kVertexMask = 0x3fffffffu;

GEODISK_CONST uint kNoHalfEdge = 0xffffffffu;
GEODISK_CONST uint kWholeFan = 0xffffffffu;

// Rows of the vertex table carry the generation of the disk that wrote them, in the two top bits of the
// vertex and of the distance. The table is therefore emptied only once per this many disks.
GEODISK_CONST uint kMaxGenerations = 15u;
GEODISK_CONST uint kTagShift = 30u;
GEODISK_CONST uint kTagMask = 0xc0000000u;

// Maximum of iterations of each loop of detect in one trip of its main loop.
GEODISK_CONST uint kMaxProbes = 8u;       // rows of the vertex table
GEODISK_CONST uint kCornersPerTrip = 8u;   // corners of a fan
GEODISK_CONST uint kScanPerTrip = 32u;     // candidates
GEODISK_CONST uint kKeptPerEdge = 4u;      // kept windows, see lib/trim.glsl
// All loops: an event taken and two vertices reached, two children left and pushed, kept windows.
GEODISK_CONST uint kIterationsPerTrip = 1u + kCornersPerTrip + 3u * kMaxProbes + 6u +
                                        (kKeptPerEdge + 1u) + kScanPerTrip;
// Trips per step. Between steps a lane whose disk is complete takes its next slot.
GEODISK_CONST uint kTripsPerStep = 16u;
GEODISK_CONST uint kClearPerStep = 64u;    // rows of the vertex table
GEODISK_CONST uint kBlocksPerStep = 16u;   // active conflicts of a complete disk
GEODISK_CONST uint kIterationsPerStep =
    1u + kClearPerStep + kBlocksPerStep + kTripsPerStep * kIterationsPerTrip;
// In addition, if events wait in a heap: one taken and two pushed per trip, each through all levels of the
// largest heap, 2^kMaxLevels. If windows wait there too, two more.
GEODISK_CONST uint kMaxLevels = 26u;
GEODISK_CONST uint kHeapIterationsPerStep = kTripsPerStep * 3u * (kMaxLevels + 1u);
GEODISK_CONST uint kTrimIterationsPerStep = kTripsPerStep * 5u * (kMaxLevels + 1u);
// Disks in waves: what a lane goes through of a phase in a step, and corners of a fan that one event
// lights. Waves after which their step doubles, in case the first face was far smaller than others.
GEODISK_CONST uint kItemsPerStep = 32u;
GEODISK_CONST uint kMinGroupWindows = 4u; // A disk begins with three.
GEODISK_CONST uint kCornersPerEvent = 16u;
GEODISK_CONST uint kWavesPerStep = 256u;
// A step is halved after so many vertices that were lit again, and a quarter of those in the disk.
GEODISK_CONST uint kLitAgain = 16u;
// Such a step counts as so many of a lane that works alone.
GEODISK_CONST uint kGroupStepCost = 16u;
// All phases: vertices looked up to propose and to spread, candidates scanned, windows left and pushed,
// corners lit.
GEODISK_CONST uint kIterationsPerGroupStep =
    1u + kItemsPerStep * (2u + (1u + 2u * (kMaxProbes + 1u)) + (1u + kScanPerTrip) + 1u +
                          (1u + 2u * (kMaxProbes + 1u) + 5u) + (1u + kCornersPerEvent) + 2u);
// Candidates that an invocation of resolve may hold to decide, and list entries that it visits per
// dispatch.
GEODISK_CONST uint kMaxAtHand = 8u;
GEODISK_CONST uint kListPerDispatch = 4096u;

// Grids over boxes with cells at least half a minimum distance wide. A disk reaches kGridReach cells on
// either side of its own, kGridDigits in all. A turn encodes which of them are next, with a digit of
// kDigitBits per axis.
GEODISK_CONST uint kMaxAxes = 6u;
GEODISK_CONST uint kGridReach = 2u;
GEODISK_CONST uint kGridDigits = 5u;
GEODISK_CONST uint kDigitBits = 3u;
GEODISK_CONST uint kDigitMask = 7u;
// In AxisRec::cells: the axis is periodic.
GEODISK_CONST uint kPeriodicAxis = 0x80000000u;
// Candidates tested per trip of grid_detect, at most, after it has found the cells of a row.
GEODISK_CONST uint kScanPerGridTrip = 16u;
GEODISK_CONST uint kIterationsPerGridTrip =
    1u + 3u * kMaxAxes + kGridDigits + kScanPerGridTrip * (1u + kMaxAxes);

// A disk of v vertices restarts to trim once it has pushed kUntrimmedWindows + v (kUntrimmedEach +
// kUntrimmedPerRoot sqrt(v)) windows and events, for v up to kUntrimmedVertices. Disks of real meshes mostly
// have about v sqrt(v). In a strip all windows go the same way: where a chain is longer than v / kStripChain,
// the root counts as kStripRoot at most, and in a strip of longer chains than kLongStrip not at all.
GEODISK_CONST uint kUntrimmedWindows = 1024u;
GEODISK_CONST uint kUntrimmedInGroups = 65536u; // in place of kUntrimmedWindows
GEODISK_CONST uint kUntrimmedEach = 32u;
GEODISK_CONST uint kUntrimmedPerRoot = 4u;
GEODISK_CONST uint kStripChain = 4u;
GEODISK_CONST uint kStripRoot = 24u;
GEODISK_CONST uint kLongStrip = 512u;
GEODISK_CONST uint kUntrimmedVertices = 65536u;
// Edges whose windows a trimming disk keeps, a power of two; kKeptPerEdge windows each.
GEODISK_CONST uint kKeptEdges = 2048u;
// Numbers that a target may have: vertices of one place.
GEODISK_CONST uint kMaxNames = 4096u;
// Records of disks are counted up to about as many, so that the count never wraps.
GEODISK_CONST uint kMaxRecorded = 0x80000000u;
GEODISK_CONST uint kWindowWaits = 0xffffffffu; // marks a window in the heap, instead of an event's vertex
GEODISK_CONST uint kNoWindow = 0xffffffffu;

// Rows of a face (without its lengths), of its radii, of a lane record, of a window and of a kept window.
GEODISK_CONST uint kFaceRows = 3u;
GEODISK_CONST uint kSpaceRows = 6u; // of a face, for distances through space
GEODISK_CONST uint kRadiiRows = 2u;
GEODISK_CONST uint kAxisRows = 2u;
GEODISK_CONST uint kPlacedRows = 3u; // of a sample in the caller's buffer
GEODISK_CONST uint kPartWords = 8u;  // words of a surface, if there are several
GEODISK_CONST uint kLaneRows = 11u;
// Rows of a disk in waves: those of the record of its work group, of a window, and of a vertex.
GEODISK_CONST uint kGroupRows = 7u;
GEODISK_CONST uint kItemRows = 2u;
GEODISK_CONST uint kGroupVertexRows = 2u;
GEODISK_CONST uint kWindowRows = 2u;
GEODISK_CONST uint kKeptRows = 2u;
// Rows of a lane for trimming: all windows that it keeps.
GEODISK_CONST uint kTrimRows = kKeptRows * kKeptPerEdge * kKeptEdges;

// Specialization constants.
GEODISK_CONST uint kSpecLocalSize = 0u; // of kernels over candidates and samples
GEODISK_CONST uint kSpecNativeRounding = 1u;
GEODISK_CONST uint kSpecPoolBlock = 2u;
GEODISK_CONST uint kSpecCountedLanes = 3u;
GEODISK_CONST uint kSpecDimension = 5u;
GEODISK_CONST uint kSpecCurved = 6u;
GEODISK_CONST uint kSpecAdaptive = 7u; // radii vary
GEODISK_CONST uint kSpecEventHeap = 8u; // vertex events wait in a heap, else in a ring
GEODISK_CONST uint kSpecSeveral = 9u; // several surfaces, each with its own seed, density and stages
GEODISK_CONST uint kSpecTrims = 10u;  // disks with very many windows trim them
GEODISK_CONST uint kSpecManyRows = 11u; // faces have several rows of cells
GEODISK_CONST uint kSpecSlotLocalSize = 4u; // of kernels over slots and lanes
GEODISK_CONST uint kSpecKeyed = 13u; // faces are drawn by keys of the caller
GEODISK_CONST uint kSpecLanesApart = 12u; // pool blocks of one lane
GEODISK_CONST uint kSpecAvoids = 15u; // points to avoid have disks
GEODISK_CONST uint kSpecClasses = 16u; // candidates have classes
GEODISK_CONST uint kSpecPoints = 17u;  // disks tell which candidates they reach, else which vertices
GEODISK_CONST uint kSpecBounded = 18u; // vertices may have bounds where disks of settled samples end
GEODISK_CONST uint kSpecGroupLanes = 14u; // local size of group_detect: lanes that compute one disk

// Candidates per work group of kernels over candidates: lanes, and candidates per lane.
GEODISK_CONST uint kWideLanes = 128u;
GEODISK_CONST uint kDrawPerLane = 16u;
GEODISK_CONST uint kDrawBlock = kWideLanes * kDrawPerLane;
// Lanes of select: few, since most have no candidate to put into a slot.
GEODISK_CONST uint kSelectLanes = 32u;
GEODISK_CONST uint kSelectBlock = 4096u;
// Places per range of orders in the list of idle candidates.
GEODISK_CONST uint kListRange = 256u;
// Up to this many slots, one work group ranks the candidates and fills batches exactly. Larger batches
// leave some slots free.
GEODISK_CONST uint kMaxRanked = 128u;
// Maximum of ranges that this work group visits.
GEODISK_CONST uint kMaxRangesRanked = 64u;
GEODISK_CONST uint kMaxListed = 0x800000u;

// Words per work group of the scan: lanes, and words per lane.
GEODISK_CONST uint kScanLanes = 64u;
GEODISK_CONST uint kScanPerLane = 32u;
GEODISK_CONST uint kScanBlock = 2048u;
// Maximum of subgroups of a work group whose trips are counted separately.
GEODISK_CONST uint kMaxCountedSubgroups = 256u;
// Sums that a step of the scan over the lanes adds.
GEODISK_CONST uint kScanTerms = 8u;

GEODISK_END_SHARED

#endif
