// Storage structs. Only four-byte scalars, so that std430 offsets are 0, 4, 8, ... in both
// languages. Hot ones are read in shaders as whole rows of four words (uvec4), one comment line
// per row here.
#ifndef GEODISK_SHARED_RECORDS_H
#define GEODISK_SHARED_RECORDS_H

#include "constants.h"

GEODISK_BEGIN_SHARED

// A half-edge in units of the minimum distance, with the angle of its face at its origin.
struct HalfEdgeRec {
    float length; float cosine; float sine; uint origin;
};

// Follows the three half-edges of a face: what they are linked to, and the face's word of cells.
struct FaceLinksRec {
    uint around0; uint around1; uint around2; uint cells;
};

// The radii at the corners of a face, how far disks reach into it (RadiusField::reach_bounds), and
// what candidates are proposed by (RadiusField::spreads). Only where radii vary.
struct RadiiRec {
    float radius0; float radius1; float radius2; float bound;
    float spread0; float spread1; float spread2; float spare;
};

struct FanRec {
    uint first_corner; uint corner_count; uint total_angle; uint flags;
};

struct AliasRec {
    uint threshold; uint alias;
};

// An axis of the grid over a box. Coordinates are multiples of 2^-32 of the side.
struct AxisRec {
    uint cells;    // along the axis, and kPeriodicAxis
    uint stride;   // a cell further along the axis, so many heads further in the table
    float unit;    // 2^-32 of the side, in minimum distances
    float width;   // of a cell, in minimum distances
};

// An accepted candidate, its rank among all. The weights are multiples of 2^-24 and that of the first
// corner is exactly one minus both.
struct SampleRec {
    uint rank; uint face; float weight1; float weight2;
};

// One active candidate, and what its disk took and found; or a sample of an earlier chunk, whose rank
// wraps around from below the chunk's first. While calls are counted, the last three words are the
// cursor in the list, the nearest conflict and the one to start from. Where distances go through
// space, the three words behind the rank tell which cells are next, and the candidates left in the
// last ones.
struct SlotRec {
    uint place; uint phase; uint idle_conflicts; uint active_conflicts;
    uint rank; uint face; float weight1; float weight2;
    uint tested; uint pushed; uint most_waiting; uint vertices;
    uint longest_chain; uint blocked; uint resolved; uint spare;
};

// Where a lane stands with the slot it works on, at the head of its slice, so that detect can stop at
// any trip and go on.
struct LaneRec {
    uint slot; uint phase; uint idle_conflicts; uint active_conflicts;
    uint windows; uint event_head; uint event_tail; uint generation;
    // The operation in flight: what spreads, in the frame of half_edge.
    uint half_edge; uint mode; float x; float y;
    float b0; float b1; float sigma; uint chain;
    uint known; uint cursor; uint cursor_end; uint corner_ahead;
    uint scan_place; uint scan_end; uint scan_row; uint scan_row_end;
    uint scan_columns; uint scan_stride; uint tested; uint pushed;
    uint most_waiting; uint longest_chain; uint vertices; uint spare;
    uint entered_by; uint entry_angles; uint fan_angle; uint fan_flags;
};

// The run as a whole. The leading words are the indirect sizes of the kernels per slot, of find_idle
// and of detect. Those before `accepted` start from zero with every chunk.
struct ControlRec {
    uint groups_x; uint groups_y; uint groups_z;
    uint find_x; uint find_y; uint find_z;
    uint detect_x; uint detect_y; uint detect_z; // none once the disks of a batch are complete
    uint abi;
    uint next_rank;        // every lower rank is decided or active
    uint batch_rank;       // next_rank before the active batch was selected
    uint next_sample;      // every lower one of the settled samples has rejected or is about to
    uint batch_sample;     // next_sample before the active batch was selected
    uint slots_used;       // slots of the active batch
    uint next_slot;        // the first that no lane has taken yet
    uint incomplete;       // slots whose disk is not complete, on surfaces
    uint unfinished;       // slots whose disk is not complete or not yet in the blockers
    uint undecided;        // slots neither accepted nor rejected; where calls are counted, besides
                           // those whose calls are not known yet
    uint overflow;         // kOverflow* bits
    uint done;             // 1 once no idle candidate is left, or stop_count accepted
    uint accepted;         // in all chunks
    uint settled;          // in the chunks before; their samples are in the buffer
    uint iterations;       // batches selected
    uint disks;            // disks completed
    uint windows_low;      // windows pushed in completed disks, 64 bits
    uint windows_high;
    uint tested_low;       // candidates tested in completed disks, 64 bits
    uint tested_high;
    uint most_waiting;
    uint longest_chain;    // of accepted candidates
    uint most_vertices;
    uint most_conflicts;
    uint trips_low;        // of all lanes in detect, 64 bits; 0 where they are not counted
    uint trips_high;
    uint lane_trips_low;   // the same if every lane did as many as the busiest of its subgroup
    uint lane_trips_high;
    uint call_bins[kCallBins]; // candidates by their calls of CheckStatus, where these are counted
    uint calls_low;        // all calls, 64 bits
    uint calls_high;
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(HalfEdgeRec) == 16 && offsetof(HalfEdgeRec, origin) == 12);
static_assert(sizeof(FaceLinksRec) == 16 && offsetof(FaceLinksRec, cells) == 12);
static_assert(sizeof(RadiiRec) == 32 && offsetof(RadiiRec, spare) == 28);
static_assert(sizeof(FanRec) == 16 && offsetof(FanRec, flags) == 12);
static_assert(sizeof(AliasRec) == 8 && offsetof(AliasRec, alias) == 4);
static_assert(sizeof(AxisRec) == 16 && offsetof(AxisRec, width) == 12);
static_assert(sizeof(SampleRec) == 16 && offsetof(SampleRec, weight2) == 12);
static_assert(sizeof(SlotRec) == 64 && offsetof(SlotRec, spare) == 60);
static_assert(sizeof(LaneRec) == 144 && offsetof(LaneRec, fan_flags) == 140);
static_assert(sizeof(ControlRec) == 196 && offsetof(ControlRec, calls_high) == 192);
} // namespace geodisk::gpu
#endif

#endif
