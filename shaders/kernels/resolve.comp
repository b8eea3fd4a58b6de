#version 450
#extension GL_GOOGLE_include_directive : require
// Decides the active batch (paper CheckStatus, without recursion): a candidate that no undecided
// one of lower rank blocks is accepted and rejects what its disk holds; a rejected one lifts its
// blocks. Blocks only fall and rejections only come, so every order of events ends the same.
// One invocation per slot; resumable, since lists may be long.
// reads: pool lists, slots, marks   writes: states, slots, control, blockers   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, coherent, uint, states);
GEODISK_BUFFER(kBindMarks, readonly, uint, marks);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindPool, readonly, uvec4, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= control.slots_used || control.unfinished > 0u) {
        return;
    }
    uvec4 head = slots[slot * kSlotRows];
    uint place = head.x;
    if ((states[place] & kStateMask) != kActive) {
        return;
    }
    uint blocks = atomicOr(blockers[slot], 0u);
    bool rejected = (blocks & kBlockedForGood) != 0u;
    if (!rejected && blocks != 0u) {
        return;
    }
    // Active conflicts first; only an accepted candidate goes on to the idle ones.
    uint resolved = slots[slot * kSlotRows + 3u].z;
    uint total = head.w + (rejected ? 0u : head.z);
    uint end = min(total, resolved + kListPerDispatch);
    for (; resolved < end; ++resolved) {
        bool is_active = resolved < head.w;
        uint at = is_active ? active_entry(resolved) : resolved - head.w;
        uint other = pool[list_row(slot) + (at >> 2)][at & 3u];
        if (!is_active) {
            atomicOr(states[other], kRejected);
            continue;
        }
        uint other_slot = marks[other];
        if (other_slot > slot) {
            if (rejected) {
                atomicAdd(blockers[other_slot], 0xffffffffu);
            } else {
                atomicOr(blockers[other_slot], kBlockedForGood);
            }
        }
    }
    slots[slot * kSlotRows + 3u].z = resolved;
    if (resolved == total) {
        atomicXor(states[place], kActive ^ (rejected ? kRejected : kAccepted));
        atomicAdd(control.undecided, 0xffffffffu);
        if (!rejected) {
            atomicAdd(control.accepted, 1u);
            // Of accepted candidates alone: which others get a disk depends on the slots, and the
            // guard must not.
            atomicMax(control.longest_chain, slots[slot * kSlotRows + 3u].x);
        }
    }
}
