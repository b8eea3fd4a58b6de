#version 450
#extension GL_GOOGLE_include_directive : require
// Decides the active batch (paper CheckStatus, without recursion): a candidate that no undecided
// one of lower rank blocks is accepted and rejects what its disk holds; a rejected one lifts its
// blocks. Blocks only fall and rejections only come, so every order of events ends the same. A sample
// of an earlier chunk has been accepted; nothing blocks it, and it only rejects.
// One invocation per slot; resumable, since lists may be long.
// reads: pool lists, slots, marks   writes: states, slots, control, blockers
// spec: local size, pool block

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_BUFFER(kBindStates, coherent, uint, states);
GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_ROWS(kBindPool, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"
#include "../lib/conflicts.glsl"

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= control.slots_used || control.unfinished > 0u) {
        return;
    }
    uvec4 head = slots[slot * kSlotRows];
    uint place = head.x;
    if (head.y != kSlotBlocked) {
        return;
    }
    uint blocks = atomicOr(blockers[slot], 0u);
    bool rejected = (blocks & kBlockedForGood) != 0u;
    if (!rejected && blocks != 0u) {
        return;
    }
    // Active conflicts first; only an accepted candidate goes on to the idle ones.
    uint resolved = slots[slot * kSlotRows + 3u].z;
    uint end = min(head.w, resolved + kListPerDispatch);
    for (; resolved < end; ++resolved) {
        uint other_slot = word_at(marks, active_conflict(slot, resolved));
        if (other_slot > slot) {
            if (rejected) {
                atomicAdd(blockers[other_slot], 0xffffffffu);
            } else {
                atomicOr(blockers[other_slot], kBlockedForGood);
            }
        }
    }
    uint total = head.w + (rejected ? 0u : head.z);
    if (resolved >= head.w) {
        // Four at a time: a budget in between is a multiple of four.
        end = min(total, resolved + kListPerDispatch);
        for (; resolved < end; resolved += 4u) {
            uint at = resolved - head.w;
            uvec4 others = four_conflicts(slot, at);
            uint left = end - resolved;
            atomicOr(states[others.x], kRejected);
            if (left > 1u) {
                atomicOr(states[others.y], kRejected);
            }
            if (left > 2u) {
                atomicOr(states[others.z], kRejected);
            }
            if (left > 3u) {
                atomicOr(states[others.w], kRejected);
            }
        }
        resolved = min(resolved, total);
    }
    slots[slot * kSlotRows + 3u].z = resolved;
    if (resolved == total) {
        slots[slot * kSlotRows].y = kSlotDecided;
        if (atomicAdd(control.undecided, 0xffffffffu) == 1u) {
            control.groups_x = 0u;
        }
        if (place == kNoPlace) {
            return;
        }
        atomicXor(states[place], kActive ^ (rejected ? kRejected : kAccepted));
        if (!rejected) {
            atomicAdd(control.accepted, 1u);
            // Of accepted candidates alone: which others get a disk depends on the slots, and the
            // guard must not.
            atomicMax(control.longest_chain, slots[slot * kSlotRows + 3u].x);
        }
    }
}
