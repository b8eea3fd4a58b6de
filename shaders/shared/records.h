// Storage structs. They only have four-byte scalars, so that std430 offsets are 0, 4, 8, ... in both
// languages. Shaders read frequently used ones as rows of four words (uvec4); each line of fields is a row.
#ifndef GEODISK_SHARED_RECORDS_H
#define GEODISK_SHARED_RECORDS_H

#include "constants.h"
#include "samples.h"

GEODISK_BEGIN_SHARED

// A half-edge: the angle of its face at its origin, the origin, and the next half-edge of the edge.
struct HalfEdgeRec {
    float cosine; float sine; uint origin; uint around;
};

// Data of a face that depends on the minimum distance: the lengths of its half-edges in units of it, and
// its cell word.
struct FaceLengthsRec {
    float length0; float length1; float length2; uint cells;
};

// Radii of a face, if radii vary: the radii at its corners, or for a density RadiusField::packing,
// negative; how far disks reach into it (RadiusField::reach_bounds); what candidates are proposed by
// (RadiusField::spreads); how much denser they are (RadiusField::densities).
struct RadiiRec {
    float radius0; float radius1; float radius2; float bound;
    float spread0; float spread1; float spread2; float density;
};

// One of several surfaces: its seed, expected candidates per stage and unit of area, its number of stages;
// its largest radius, in its own units, its first face, and its lag.
struct PartRec {
    uint seed_low; uint seed_high; float intensity; uint stages;
    float radius; uint first_face; uint lag; uint spare;
};

struct FanRec {
    uint first_corner; uint corner_count; uint total_angle; uint flags;
};

// An axis of a box: the grid for finding disks, then the cells for drawing candidates. A coordinate is a
// number of steps.
struct AxisRec {
    uint cells;    // cells along the axis, and kPeriodicAxis
    uint stride;   // heads in the table from one cell to the next along the axis
    float unit;    // length of a step, in minimum distances
    float width;   // width of a cell, in minimum distances
    uint draw_cells;
    uint draw_width; // width of a cell, in steps; 0 for all 2^32
    uint last_width; // width of the last cell
    uint per_step;   // cells of the grid per step, in units of 2^-32
};

// An active candidate, or a sample of an earlier chunk, which has no place. It has the four words of a
// sample, and the blocks from candidates before it in dart order.
struct SlotRec {
    uint place; uint phase; uint idle_conflicts; uint active_conflicts;
    uint order; uint face; uint weight1; uint weight2;
    uint blocks; uint cursor; uint longest_chain; uint tested;
    // For distances through space: which cells are next, and the candidates left in the last. On surfaces
    // `turn` is the word of the radius of a point to avoid, else 0.
    uint turn; uint scan_place; uint scan_end; uint rows_visited;
};

// State of a lane with its slot, at the head of its slice. It lets detect stop at any trip and continue.
struct LaneRec {
    uint slot; uint phase; uint idle_conflicts; uint active_conflicts; // kPhase*; conflicts listed so far
    // Windows on the stack; events taken from the ring (0 for the heap) and one past the last; generation
    // of the disk in the vertex table, 1 to kMaxGenerations.
    uint windows; uint event_head; uint event_tail; uint generation;
    // The operation in flight, in the frame of half_edge: kMode*, the source, the lit interval of a window,
    // the distance of the source, crossings so far.
    uint half_edge; uint mode; float x; float y;
    float b0; float b1; float sigma; uint chain;
    // Known distances of the window's edge, see leave(), or the shadow of a fan; progress of a phase: the next table row, edge or
    // corner, and the end; the next lit corner.
    uint known; uint cursor; uint cursor_end; uint corner_ahead;
    // Next candidates in the current row of cells; first cell within reach of the next row, and of the row
    // after the last; cells of a row within reach, and of a whole row.
    uint scan_place; uint scan_end; uint scan_row; uint scan_row_end;
    uint scan_columns; uint scan_stride; uint tested; uint pushed; // candidates; windows and events
    uint max_waiting; uint longest_chain; uint vertices; // waiting on the stack, or of events
    uint remembered; // half-edge of a face that the window came through, see turns_back()
    // The fan that is lit: angles that its path came from, and the one all around; the shadow in corner_ahead.
    // See lib/shadow.glsl.
    int entry_low; int entry_high; int entry_turn; uint shadow_ahead;
    // Windows and events pushed before the disk restarted to trim, 0 if it has not; then the first free
    // window, see lib/waiting.glsl.
    uint trims; uint free_place;
    // The window that comes next, if it is not on the stack: its rows, with the source's distance of the
    // operation in flight. The first word is kNoWindow if there is none.
    uint held_known; float held_b1;
    uint held_around; float held_x; float held_y; float held_b0;
};

// State of a work group that computes a disk in waves, at the head of its slice. It lets group_detect stop at
// any step and continue.
struct GroupRec {
    uint slot; uint phase; uint cursor; uint turn; // kGroup*; progress; which lists are this wave's
    uint items; uint next_items; uint events; uint next_events; // of this wave and of the next
    uint scans; uint next_scans; uint scan_turn; uint proposals;
    // Windows of this wave; chain when it began; events of vertices that had one, since the step changed.
    uint taken; uint longest_before; uint lit_again; uint spare;
    // Windows nearer than `end` belong to the wave, which goes so far beyond the nearest; of the next wave
    // the nearest distance, as a word; waves.
    float end; float step; uint nearest; uint waves;
    uint idle_conflicts; uint active_conflicts; uint conflicts; uint vertices; // so far
    uint tested; uint pushed; uint max_waiting; uint longest_chain; // as of LaneRec
};

// Light of the disk of a settled sample on a face: the half-edge, and 1 if all of the face is lit;
// the sample; the distance of the source, and what a path may be as long as, without the radius of
// its target, where radii vary; negative for a point to avoid. The source in the frame of the
// half-edge, and the part of the edge through which it is seen.
struct LitRec {
    uint place; uint sample_index; float sigma; float limit;
    float x; float y; float low; float high;
};

// A path that a disk found: from a settled sample to a vertex or candidate, by its number or place.
struct HitRec {
    uint sample_index; uint target; float distance; uint spare;
};

// An entry of a list of neighbours while it is made: the source, in the part at hand, and the number of the
// neighbour; its distance in mesh units, as a word, so that words compare as distances do.
struct NeighbourRec {
    uint source; uint number; uint distance; uint spare;
};

// State of the run. The leading words are the indirect sizes of select, detect and resolve. The words
// before `accepted` start from zero with every chunk.
struct ControlRec {
    uint select_x; uint select_y; uint select_z; // 0 while a batch is undecided
    uint detect_x; uint detect_y; uint detect_z; // 0 once the disks of a batch are complete
    uint groups_x; uint groups_y; uint groups_z;
    uint abi;
    uint generation;       // number of the begin or rewind that the run continued from
    uint drawn;            // candidates drawn in the chunk
    uint mode;             // kSelect*
    uint first_order;      // all candidates of lower order are decided or active
    uint batch_end;        // idle candidates of lower order belong to the batch
    uint list_end;         // the list holds all idle candidates from first_order up to it
    uint list_first;       // first order of the list, which is kept by ranges of orders
    uint list_width;       // width of a range
    uint list_left;        // lowest order that the list had no room for
    uint listed_blocks;    // blocks of kSelectBlock candidates visited for the list
    uint first_range;      // first range that select visits
    uint longest_span;     // maximum of orders of a batch
    uint first_left;       // lowest order that found no slot; slots of this and higher orders are void
    uint due;              // candidates that asked for a slot
    uint selected_groups;  // work groups of select that are done
    uint idle;             // candidates neither decided nor active
    uint next_sample;      // next settled sample; all before have rejected or are about to
    uint slots_used;       // slots of the active batch
    uint next_slot;        // first slot that no lane has taken yet
    uint large;            // slots whose disks lanes have left to work groups, listed in SlotRec::scan_place
    uint next_large;       // first of them that no work group has taken yet
    uint large_x; uint large_y; uint large_z; // size of group_detect for them; 0 if there are none
    uint incomplete;       // slots whose disk is not complete
    uint undecided;        // slots neither accepted nor rejected
    uint overflow;         // kOverflow* bits
    uint endless_face;     // with kOverflowEndless: 1 plus the face of the sample
    uint done;             // 1 once no idle candidate is left, or stop_count accepted
    uint counted_order;    // highest order that count_orders counts
    uint below;            // candidates up to that order
    uint first_open;       // while samples are sorted: the lowest undecided order
    uint ready;            // samples that are in order and final, of all chunks
    uint accepted;         // samples of all chunks
    uint settled;          // samples of earlier chunks
    uint ordered;          // accepted ones that are already in final order
    uint next_ordered;     // value of `ordered` for the next time
    uint batches;          // selected
    uint steps;            // steps of lanes, and continued slots, modulo 2^32
    uint disks;            // disks completed
    uint large_disks;      // disks that lanes have left to work groups
    uint windows_low;      // windows pushed in completed disks, 64 bits
    uint windows_high;
    uint tested_low;       // candidates tested in completed disks, 64 bits
    uint tested_high;
    uint max_waiting;
    uint max_windows;      // pushed in a disk
    uint longest_chain;    // in disks of accepted candidates
    uint max_vertices;
    uint max_conflicts;
    uint trips_low;        // trips of all lanes in detect, 64 bits; 0 if not counted
    uint trips_high;
    uint lane_trips_low;   // trips if every lane did as many as the busiest of its subgroup
    uint lane_trips_high;
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(HalfEdgeRec) == 16 && offsetof(HalfEdgeRec, around) == 12);
static_assert(sizeof(FaceLengthsRec) == 16 && offsetof(FaceLengthsRec, cells) == 12);
static_assert(sizeof(RadiiRec) == 32 && offsetof(RadiiRec, density) == 28);
static_assert(sizeof(PartRec) == 32 && offsetof(PartRec, spare) == 28);
static_assert(sizeof(FanRec) == 16 && offsetof(FanRec, flags) == 12);
static_assert(sizeof(AxisRec) == 32 && offsetof(AxisRec, per_step) == 28);
static_assert(sizeof(SlotRec) == 64 && offsetof(SlotRec, rows_visited) == 60);
static_assert(sizeof(LaneRec) == 176 && offsetof(LaneRec, held_b0) == 172);
static_assert(sizeof(GroupRec) == 112 && offsetof(GroupRec, longest_chain) == 108);
static_assert(sizeof(LitRec) == 32 && offsetof(LitRec, high) == 28);
static_assert(sizeof(ControlRec) == 256 && offsetof(ControlRec, lane_trips_high) == 252);
} // namespace geodisk::gpu
#endif

#endif
