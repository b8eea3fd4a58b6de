// Storage structs. Only four-byte scalars, so that std430 offsets are 0, 4, 8, ... in both
// languages. Hot ones are read in shaders as whole rows of four words (uvec4), one comment line
// per row here.
#ifndef GEODISK_SHARED_RECORDS_H
#define GEODISK_SHARED_RECORDS_H

#include "constants.h"
#include "samples.h"

GEODISK_BEGIN_SHARED

// A half-edge: the angle of its face at its origin, that vertex, and what it is linked to.
struct HalfEdgeRec {
    float cosine; float sine; uint origin; uint around;
};

// What the distance tells of a face: the lengths of its half-edges, in units of the minimum distance,
// and its word of cells.
struct FaceLengthsRec {
    float length0; float length1; float length2; uint cells;
};

// The radii at the corners of a face, or where they come from a density RadiusField::packing, negative;
// how far disks reach into it (RadiusField::reach_bounds), what candidates are proposed by
// (RadiusField::spreads), and how many more of them it has (RadiusField::densities). Only where radii
// vary.
struct RadiiRec {
    float radius0; float radius1; float radius2; float bound;
    float spread0; float spread1; float spread2; float density;
};

// A surface among several: its seed, candidates that one of its stages expects per unit of area, and how
// many stages it has; its largest radius, in its own units, and its first face.
struct PartRec {
    uint seed_low; uint seed_high; float intensity; uint stages;
    float radius; uint first_face; uint spare0; uint spare1;
};

struct FanRec {
    uint first_corner; uint corner_count; uint total_angle; uint flags;
};

// An axis of a box. A coordinate is a number of steps. The grid that disks are found by, then the
// cells that candidates are drawn by.
struct AxisRec {
    uint cells;    // along the axis, and kPeriodicAxis
    uint stride;   // a cell further along the axis, so many heads further in the table
    float unit;    // a step, in minimum distances
    float width;   // of a cell, in minimum distances
    uint draw_cells;
    uint draw_width; // of a cell, in steps; 0 for all 2^32
    uint last_width; // of the last one
    uint per_step;   // cells of the grid for each step, in units of 2^-32
};

// One active candidate; or a sample of an earlier chunk, which has no place. Each has a sample's
// four words, and the blocks that candidates before it in dart order have put on it.
struct SlotRec {
    uint place; uint phase; uint idle_conflicts; uint active_conflicts;
    uint order; uint face; uint weight1; uint weight2;
    uint blocks; uint cursor; uint longest_chain; uint calls;
    // Where distances go through space: which cells are next, and the candidates left in the last.
    // While calls are counted: the slots that were counted last, and that come next so far.
    uint turn; uint scan_place; uint scan_end; uint rows_visited;
};

// Where a lane stands with the slot it works on, at the head of its slice, so that detect can stop at
// any trip and go on.
struct LaneRec {
    uint slot; uint phase; uint idle_conflicts; uint active_conflicts; // kPhase*; listed so far
    // Windows on the stack; events taken from the ring (0 of the heap) and one past the last; which disk
    // of the vertex table this is, 1 to kMostGenerations.
    uint windows; uint event_head; uint event_tail; uint generation;
    // The operation in flight, in the frame of half_edge: kMode*, the source, the lit interval of a
    // window, the source's distance, crossings so far.
    uint half_edge; uint mode; float x; float y;
    float b0; float b1; float sigma; uint chain;
    // What a window knew of its edge's ends, see leave(); where a phase stands: the next table row, edge
    // or corner, and the end; the lit corner that comes next.
    uint known; uint cursor; uint cursor_end; uint corner_ahead;
    // Candidates that come next in the row of cells at hand; the next row's first cell within reach,
    // that of the row after the last; cells of a row within reach, and of a whole row.
    uint scan_place; uint scan_end; uint scan_row; uint scan_row_end;
    uint scan_columns; uint scan_stride; uint tested; uint pushed; // candidates; windows and events
    uint most_waiting; uint longest_chain; uint vertices; // on the stack or of events
    uint remembered; // a half-edge of a face that the window came through, see turns_back()
    // The vertex whose fan is walked: the corner its path came in through, or kWholeFan.
    uint entered_by; uint entry_angles; uint fan_angle; uint fan_flags;
    // Windows and events pushed before the disk began again to trim them, 0 where it has not; then the
    // first window that is free again, see lib/waiting.glsl.
    uint trims; uint free_place;
    // The window that comes next, where it is not on the stack: as its rows are, with the source's distance of
    // the operation in flight. kNoWindow for the first word if there is none.
    uint held_known; float held_b1;
    uint held_around; float held_x; float held_y; float held_b0;
};

// The run as a whole. The leading words are the indirect sizes of select, of detect, and of resolve.
// Those before `accepted` start from zero with every chunk.
struct ControlRec {
    uint select_x; uint select_y; uint select_z; // none while a batch is not decided
    uint detect_x; uint detect_y; uint detect_z; // none once the disks of a batch are complete
    uint groups_x; uint groups_y; uint groups_z;
    uint count_x; uint count_y; uint count_z;    // of count_calls, once a batch is decided
    uint abi;
    uint generation;       // of the begin or rewind that the run went on from last
    uint drawn;            // candidates of the chunk
    uint mode;             // kSelect*
    uint first_order;      // all of lower order are decided or active
    uint batch_end;        // idle candidates of lower order are due
    uint list_end;         // the list holds all idle candidates from first_order up to it
    uint list_first;       // from this order on; the list is kept by ranges of orders
    uint list_width;       // of a range
    uint list_left;        // lowest order that the list had no room for
    uint listed_blocks;    // of candidates that are gone through for the list, kSelectBlock each
    uint first_range;      // that select goes through
    uint longest_span;     // most orders of a batch
    uint first_left;       // lowest order that found no slot; slots of no lower one are void
    uint due;              // candidates that asked for a slot
    uint selected_groups;  // work groups of select that are done
    uint idle;             // candidates not decided, nor active
    uint next_sample;      // every lower one of the settled samples has rejected or is about to
    uint slots_used;       // slots of the active batch
    uint next_slot;        // the first that no lane has taken yet
    uint incomplete;       // slots whose disk is not complete
    uint undecided;        // slots neither accepted nor rejected
    uint uncounted;        // slots whose calls are not known yet, where these are counted
    uint overflow;         // kOverflow* bits
    uint endless_face;     // with kOverflowEndless, a face of those whose disk it is, and 1
    uint done;             // 1 once no idle candidate is left, or stop_count accepted
    uint below;            // candidates of lower order than asked for, by count_orders
    uint first_open;       // while samples are put in order: the lowest order not decided
    uint ready;            // samples that are in order and final, of all chunks
    uint accepted;         // in all chunks
    uint settled;          // in the chunks before
    uint ordered;          // accepted ones that need not be put in order any more
    uint next_ordered;     // what that will be the next time
    uint iterations;       // batches selected
    uint steps;            // of lanes, and slots gone on with later, modulo 2^32
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
static_assert(sizeof(HalfEdgeRec) == 16 && offsetof(HalfEdgeRec, around) == 12);
static_assert(sizeof(FaceLengthsRec) == 16 && offsetof(FaceLengthsRec, cells) == 12);
static_assert(sizeof(RadiiRec) == 32 && offsetof(RadiiRec, density) == 28);
static_assert(sizeof(PartRec) == 32 && offsetof(PartRec, spare1) == 28);
static_assert(sizeof(FanRec) == 16 && offsetof(FanRec, flags) == 12);
static_assert(sizeof(AxisRec) == 32 && offsetof(AxisRec, per_step) == 28);
static_assert(sizeof(SlotRec) == 64 && offsetof(SlotRec, rows_visited) == 60);
static_assert(sizeof(LaneRec) == 176 && offsetof(LaneRec, held_b0) == 172);
static_assert(sizeof(ControlRec) == 288 && offsetof(ControlRec, calls_high) == 284);
} // namespace geodisk::gpu
#endif

#endif
