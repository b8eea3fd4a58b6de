// Totals of the disks of a dispatch, summed per work group before they go to the control record.
#ifndef GEODISK_DISK_TOTALS_GLSL
#define GEODISK_DISK_TOTALS_GLSL

struct DiskTotals {
    uint steps; // of all disks, complete or not
    uint disks;
    uint windows;
    uint tested;
    uint max_waiting;
    uint max_windows;
    uint max_vertices;
    uint max_conflicts;
};

const DiskTotals kNoDisks = DiskTotals(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);

shared DiskTotals group_disks;
uint own_steps; // of this invocation

// Begins to add up. Every invocation of the group must call it.
void begin_disks() {
    own_steps = 0u;
    if (gl_LocalInvocationID.x == 0u) {
        group_disks = kNoDisks;
    }
    barrier();
}

// Adds a disk that is complete.
void add_disk(uint windows, uint tested, uint waiting, uint vertices, uint conflicts) {
    atomicAdd(group_disks.disks, 1u);
    atomicAdd(group_disks.windows, windows);
    atomicAdd(group_disks.tested, tested);
    atomicMax(group_disks.max_waiting, waiting);
    atomicMax(group_disks.max_windows, windows);
    atomicMax(group_disks.max_vertices, vertices);
    atomicMax(group_disks.max_conflicts, conflicts);
}

// Tells the totals. Every invocation of the group must call it.
void sum_disks() {
    if (own_steps > 0u) {
        atomicAdd(group_disks.steps, own_steps);
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u && group_disks.steps > 0u) {
        atomicAdd(control.steps, group_disks.steps);
        atomicAdd(control.disks, group_disks.disks);
        GEODISK_ADD_WIDE(control.windows_low, control.windows_high, group_disks.windows)
        GEODISK_ADD_WIDE(control.tested_low, control.tested_high, group_disks.tested)
        atomicMax(control.max_waiting, group_disks.max_waiting);
        atomicMax(control.max_windows, group_disks.max_windows);
        atomicMax(control.max_vertices, group_disks.max_vertices);
        atomicMax(control.max_conflicts, group_disks.max_conflicts);
    }
}

#endif
