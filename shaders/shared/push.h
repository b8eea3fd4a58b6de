// Values that a kernel is given besides the contents of its buffers: the constants of a job, which
// lie in a uniform buffer, and the push block of a dispatch.
#ifndef GEODISK_SHARED_PUSH_H
#define GEODISK_SHARED_PUSH_H

#include "abi.h"

GEODISK_BEGIN_SHARED

// Written where the candidates of a chunk are drawn, before all that reads it.
struct JobRec {
    uint capacity;        // candidates that the buffers hold
    uint faces;           // or cells that a box is drawn by
    uint vertices;
    uint cells;           // of boxes: heads of the table of cells, a power of two
    uint seed_low;
    uint seed_high;
    float limit;          // conflict below it: 1 + guard, in units of the minimum distance; in
                          // boxes its square
    float margin;         // by how much a window must be beaten before it is dropped; longer chains than
                          // usual widen both, see lib/operation.glsl
    float slack;          // by how much an interval is widened for hits
    uint path_rules;      // kRule* bits that hold of shortest paths
    uint has_keys;        // 1 if the caller gives keys for all faces: ties go by weights
    uint first_key_row;   // of the fans: where the keys begin
    uint stop_count;      // enough samples, of all chunks
    uint idle_capacity;   // places that the list of idle candidates holds
    uint buckets;         // ranges of orders by which samples are put in order
    float base_error;     // bound on the error of a distance, without that of crossings
    uint first_mask_row;  // of the fans: where the mask of faces begins; 0 if all take samples
    uint first_class_row; // of the fans: where the table of classes begins, if there are classes
    uint max_lag;        // of several surfaces: their largest lag
};

// One for all kernels but `place`: the plan, which changes when a slice overflows, the chunk, and the
// part of a pass.
struct Push {
    uint slots;           // most candidates active at a time
    uint batch;           // of them, to make active at a time; more where many share one order, or disks are uneven
    uint lanes;           // invocations that compute their disks, or work groups
    uint lanes_per_group; // of detect; 1 where a work group computes a disk together
    uint window_capacity; // windows one lane can hold, and events; a power of two
    uint table_capacity;  // vertex table of one lane, a power of two
    uint list_capacity;   // conflicts one slot can list
    uint lane_rows;       // rows of four words per lane
    uint first_list_row;  // of the pool: the slices come before
    uint first_slice_row; // of the pool: 0, or where those of work groups for large disks begin
    uint large_groups;    // work groups for the disks that lanes leave to them; 0 if there are none
    uint large_after;     // windows and events after which a lane leaves a disk to them
    uint step_budget;     // steps of detect per dispatch
    uint sample_capacity; // samples the buffer holds
    uint list_groups;     // most work groups of a select that goes through all candidates
    uint first_stage;     // of the chunk
    uint stages;          // of the chunk
    float intensity;      // candidates that one stage expects per unit of area
    uint end_order;       // candidates of this order and higher ones do not take part
    uint bucket_shift;    // an order's range lies above so many bits
    uint scan_count;      // scans: words to scan
    uint first_group;     // the work groups of a pass that earlier dispatches of it had
};

// Push block of `place`, which needs what a caller says of its own buffers. Strides and offsets are
// in words.
struct PlacePush {
    uint most;          // samples that the caller has room for
    uint last_vertex;   // of the caller's
    uint stride;        // from vertex to vertex
    uint position;      // where a vertex has its position
    uint normal;        // and its normal
    uint has_normals;   // 0 where normals are those of the faces
    uint short_indices; // 1 for 16 bits
    uint vertices_each; // that the caller draws for each sample
    float radius;       // the largest, where there is one surface
    uint first_group;   // as above
    uint avoided;       // points to avoid, which come before the samples
};

// Push block of the kernels that put neighbours in lists.
struct NeighbourPush {
    uint count;        // hits, or entries
    uint capacity;     // entries that there is room for
    uint first_source; // of the part at hand
    uint sources;      // of the part at hand
    uint all_sources;
    uint longest_word; // of the rows: where the longest one's length is
    uint width;        // entries of a row that are in order already, a power of two
    uint by_distance;  // 1 for the order by distance, then number; 0 for the order by number
    uint nearest;      // neighbours that each source keeps, or 0 for all
    uint skips_own;    // 1 where a source is not its own neighbour
    uint has_names;    // 1 where targets have other numbers than their own
    uint pairs;        // that the caller has room for
    uint unit_low;     // the mantissa, of 53 bits, and the exponent of a unit of length in mesh units
    uint unit_high;
    int unit_exponent;
    uint first_group;  // as above
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(JobRec) == 76 && offsetof(JobRec, max_lag) == 72);
// Vulkan promises 128 bytes; a caller's kernels or later ones may want some.
static_assert(sizeof(Push) <= 96);
static_assert(sizeof(NeighbourPush) <= sizeof(Push));
}
#endif

#endif
