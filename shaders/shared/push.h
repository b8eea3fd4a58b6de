// The push block, one for all kernels: what does not change during a run, and the layout of a pool
// slice, which does when a slice overflows.
#ifndef GEODISK_SHARED_PUSH_H
#define GEODISK_SHARED_PUSH_H

#include "abi.h"

GEODISK_BEGIN_SHARED

struct Push {
    uint capacity;        // candidates that the buffers hold
    uint faces;           // or cells that a box is drawn by
    uint vertices;
    uint cells;           // of boxes: heads of the table of cells, a power of two
    uint seed_low;
    uint seed_high;
    float limit;          // conflict below it: 1 + guard, in units of the minimum distance; in
                          // boxes its square
    float margin;         // by how much a window must be beaten before it is dropped
    float slack;          // by how much an interval is widened for hits
    uint path_rules;      // kRule* bits that hold of shortest paths
    uint slots;           // most candidates active at a time
    uint lanes;           // invocations that compute their disks
    uint window_capacity; // windows one lane can hold, and events; a power of two
    uint table_capacity;  // vertex table of one lane, a power of two
    uint list_capacity;   // conflicts one slot can list
    uint lane_rows;       // rows of four words per lane
    uint first_list_row;  // of the pool: the slices come before
    uint step_budget;     // steps of detect per dispatch
    uint scan_count;      // scans: words to scan
    uint sample_capacity; // samples the buffer holds
    uint first_stage;     // of the chunk
    uint stages;          // of the chunk
    float intensity;      // candidates that one stage expects per unit of area
    uint has_keys;        // 1 where faces are drawn by keys of the caller
    uint all_single;      // 1 where all faces are of one cell, whose table is then that of starts
    uint end_order;       // candidates of this order and higher ones do not take part
    uint stop_count;      // enough samples, of all chunks
    uint idle_capacity;   // places that the list of idle candidates holds
    uint buckets;         // ranges of orders by which samples are put in order
    uint bucket_shift;    // an order's range lies above so many bits
    uint first_group;     // the work groups of a pass that earlier dispatches of it had
    uint list_groups;     // most work groups of a select that goes through all candidates
};

// That of `place`, which needs what a caller says of its own buffers. Strides and offsets are in words.
struct PlacePush {
    uint most;          // samples that the caller has room for
    uint faces;
    uint vertices;      // of the meshes of the job
    uint last_vertex;   // of the caller's
    uint stride;        // from vertex to vertex
    uint position;      // where a vertex has its position
    uint normal;        // and its normal
    uint has_normals;   // 0 where normals are those of the faces
    uint short_indices; // 1 for 16 bits
    uint vertices_each; // that the caller draws for each sample
    float radius;       // the largest, where there is one surface
    uint first_group;   // as above
};

GEODISK_END_SHARED

#ifdef __cplusplus
#include <cstddef>
namespace geodisk::gpu {
static_assert(sizeof(Push) == 128 && offsetof(Push, list_groups) == 124);
}
#endif

#endif
