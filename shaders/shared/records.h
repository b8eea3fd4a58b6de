// Storage structs. Only four-byte scalars, so that std430 offsets are 0, 4, 8, ... in both
// languages. Hot ones are read in shaders as whole rows of four words (uvec4), one comment line
// per row here.
#ifndef GEODISK_SHARED_RECORDS_H
#define GEODISK_SHARED_RECORDS_H

#include "abi.h"

GEODISK_BEGIN_SHARED

// A half-edge in units of the minimum distance.
struct HalfEdgeRec {
    float length; float apex_x; float apex_y; uint origin;
    float cosine; float sine; uint around; uint fan_angles;
};

struct FanRec {
    uint first_corner; uint corner_count; uint total_angle; uint flags;
};

struct AliasRec {
    uint threshold; uint alias;
};

// A candidate. The weights of the face's second and third corner are multiples of 2^-24 and that of
// the first is exactly one minus both.
struct PointRec {
    float weight1; float weight2; uint rank; uint face;
};

// An accepted candidate; the weights as in PointRec.
struct SampleRec {
    uint rank; uint face; float weight1; float weight2;
};

// One active candidate and where its disk stands, so that detect can stop at any trip and go on.
struct SlotRec {
    uint place; uint phase; uint conflicts; uint resolved;
    uint heap_size; uint high_water; uint vertices; uint rank;
    // The operation in flight: what spreads, in the frame of half_edge.
    uint half_edge; uint mode; float x; float y;
    float b0; float b1; float sigma; uint chain;
    uint window_edge; uint cursor; uint cursor_end; uint entered_by;
    uint scan_place; uint scan_end; uint scan_row; uint scan_row_end;
    uint scan_column; uint scan_columns; uint tested; uint face;
    uint windows; uint peak; uint longest_chain; uint root;
    uint pending_key; uint pending_window; uint open_window; uint spare;
};

// The run as a whole. The three leading words are the indirect size of detect and resolve.
struct ControlRec {
    uint groups_x; uint groups_y; uint groups_z;
    uint abi;
    uint next_rank;        // every lower rank is decided or active
    uint batch_rank;       // next_rank before the active batch was selected
    uint slots_used;       // slots of the active batch
    uint unfinished;       // slots whose disk is not complete
    uint undecided;        // slots neither accepted nor rejected
    uint overflow;         // kOverflow* bits
    uint done;             // 1 once no idle candidate is left
    uint accepted;
    uint iterations;       // batches selected
    uint disks;            // disks completed
    uint windows_low;      // windows pushed in completed disks, 64 bits
    uint windows_high;
    uint tested_low;       // candidates tested in completed disks, 64 bits
    uint tested_high;
    uint largest_heap;
    uint longest_chain;    // of accepted candidates
    uint most_vertices;
    uint most_conflicts;
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(HalfEdgeRec) == 32 && offsetof(HalfEdgeRec, fan_angles) == 28);
static_assert(sizeof(FanRec) == 16 && offsetof(FanRec, flags) == 12);
static_assert(sizeof(AliasRec) == 8 && offsetof(AliasRec, alias) == 4);
static_assert(sizeof(PointRec) == 16 && offsetof(PointRec, face) == 12);
static_assert(sizeof(SampleRec) == 16 && offsetof(SampleRec, weight2) == 12);
static_assert(sizeof(SlotRec) == 144 && offsetof(SlotRec, spare) == 140);
static_assert(sizeof(ControlRec) == 88 && offsetof(ControlRec, most_conflicts) == 84);
} // namespace geodisk::gpu
#endif

#endif
