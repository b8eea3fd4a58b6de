#version 450
#extension GL_GOOGLE_include_directive : require
// A slot whose disk is complete counts itself among the blockers of the active candidates of higher
// rank in it, and its disk into the run's totals. One invocation per slot; resumable.
// reads: pool lists, marks   writes: slots, control, blockers   spec: local size, pool block

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_ROWS(kBindPool, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"
#include "../lib/conflicts.glsl"
#include "../lib/wide.glsl"

void count_disk(uint row, uint conflicts) {
    uvec4 took = slots[row + 2u];
    atomicAdd(control.unfinished, 0xffffffffu);
    atomicAdd(control.disks, 1u);
    GEODISK_ADD_WIDE(control.tested_low, control.tested_high, took.x)
    GEODISK_ADD_WIDE(control.windows_low, control.windows_high, took.y)
    atomicMax(control.most_waiting, took.z);
    atomicMax(control.most_vertices, took.w);
    atomicMax(control.most_conflicts, conflicts);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    uint row = slot * kSlotRows;
    if (slot >= control.slots_used || control.unfinished == 0u || slots[row].y != kSlotListed) {
        return;
    }
    uvec4 head = slots[row];
    uint cursor = slots[row + 3u].y;
    uint end = min(cursor + kListPerDispatch, head.w);
    for (; cursor < end; ++cursor) {
        uint other = word_at(marks, active_conflict(slot, cursor));
        if (other > slot) {
            atomicAdd(blockers[other], 1u);
        }
    }
    slots[row + 3u].y = cursor;
    if (cursor == head.w) {
        slots[row].y = kSlotBlocked;
        count_disk(row, head.z + head.w);
    }
}
