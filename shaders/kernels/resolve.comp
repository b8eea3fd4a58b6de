#version 450
#extension GL_GOOGLE_include_directive : require
// Decides the active batch (paper CheckStatus, without recursion): a candidate that no undecided
// one of lower rank blocks is accepted and rejects what its disk holds; a rejected one lifts its
// blocks. Blocks only fall and rejections only come, so every order of events ends the same.
// One invocation per slot; resumable, since lists may be long.
// reads: pool lists, slots   writes: states, slots, control, blockers   spec: local size

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, coherent, uint, states);
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
    uint first = list_row(slot);
    uint cursor = head.w;
    uint end = min(head.z, cursor + push.trip_budget);
    for (; cursor < end; ++cursor) {
        uint other = pool[first + (cursor >> 2)][cursor & 3u];
        uint state = states[other];
        if ((state & kStateMask) == kIdle || (state & kStateMask) == kRejected) {
            if (!rejected) {
                atomicOr(states[other], kRejected);
            }
        } else {
            uint other_slot = state >> kStateSlotShift;
            if (rejected) {
                atomicAdd(blockers[other_slot], 0xffffffffu);
            } else {
                atomicOr(blockers[other_slot], kBlockedForGood);
            }
        }
    }
    slots[slot * kSlotRows].w = cursor;
    if (cursor == head.z) {
        atomicExchange(states[place], rejected ? kRejected : kAccepted);
        atomicAdd(control.undecided, 0xffffffffu);
        if (!rejected) {
            atomicAdd(control.accepted, 1u);
            // Of accepted candidates alone: which others get a disk depends on the slots, and the
            // guard must not.
            atomicMax(control.longest_chain, slots[slot * kSlotRows + 7u].z);
        }
    }
}
