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

DiskTotals own_disks; // of this invocation
shared DiskTotals group_disks;

// Adds up the totals. Every invocation of the group must call it.
void sum_disks() {
    bool is_first = gl_LocalInvocationID.x == 0u;
    if (is_first) {
        group_disks = kNoDisks;
    }
    barrier();
    if (own_disks.steps > 0u) {
        atomicAdd(group_disks.steps, own_disks.steps);
        atomicAdd(group_disks.disks, own_disks.disks);
        atomicAdd(group_disks.windows, own_disks.windows);
        atomicAdd(group_disks.tested, own_disks.tested);
        atomicMax(group_disks.max_waiting, own_disks.max_waiting);
        atomicMax(group_disks.max_windows, own_disks.max_windows);
        atomicMax(group_disks.max_vertices, own_disks.max_vertices);
        atomicMax(group_disks.max_conflicts, own_disks.max_conflicts);
    }
    barrier();
    if (is_first && group_disks.steps > 0u) {
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
