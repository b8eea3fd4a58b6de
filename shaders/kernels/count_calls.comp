#version 450
#extension GL_GOOGLE_include_directive : require
// Counts how often the paper's CheckStatus would call itself for each candidate of a batch that is
// decided (paper section 5.4): once for the candidate, and as often as for itself for every active
// conflict of lower rank it comes to, upwards until one is accepted. One invocation per slot, which
// goes once through its list for each of those; resumable, since lists may be long and what the
// others count not be known yet.
// reads: states, pool lists, marks   writes: slots, control, blockers   spec: local size, pool block

#include "../lib/prelude.glsl"

layout(local_size_x_id = 0) in;

GEODISK_WORDS(kBindStates, states);
GEODISK_WORDS(kBindMarks, marks);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_ROWS(kBindPool, pool);
GEODISK_CONTROL;

#include "../lib/slice.glsl"
#include "../lib/conflicts.glsl"

void add_to_histogram(uint calls) {
    atomicAdd(control.call_bins[min(calls, kCallBins) - 1u], 1u);
    uint low = atomicAdd(control.calls_low, calls);
    if (low + calls < low) {
        atomicAdd(control.calls_high, 1u);
    }
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    uint row = slot * kSlotRows;
    // Others count theirs in this very dispatch, so `undecided` stays at or below slots_used. Samples
    // of earlier chunks have conflicts with no active candidate to count.
    if (slot >= control.slots_used || control.undecided > control.slots_used ||
        slots[row].x == kNoPlace || slots[row].y == kSlotCounted) {
        return;
    }
    // Slots ascend with rank. The conflict looked for is the lowest from `from` on, of those below
    // this slot; `nearest` is the lowest that the list shows up to the cursor, `slot` for none.
    uint count = slots[row].w;
    uint cursor = 0u;
    uint nearest = slot;
    uint from = 0u;
    uint calls = 1u;
    if (slots[row].y == kSlotCounting) {
        uvec4 left = slots[row + 3u];
        cursor = left.y;
        nearest = left.z;
        from = left.w;
        calls = blockers[slot];
    }
    bool is_known = false;
    for (uint entry = 0u; entry < kListPerDispatch; ++entry) {
        if (cursor < count) {
            uint other = word_at(marks, active_conflict(slot, cursor));
            nearest = other >= from ? min(nearest, other) : nearest;
            ++cursor;
            continue;
        }
        is_known = nearest == slot;
        uint others = is_known ? 0u : atomicOr(blockers[nearest], 0u);
        if ((others & kCallsKnown) == 0u) {
            break;
        }
        calls = min(calls + (others & kMostCalls), kMostCalls);
        is_known = (word_at(states, slots[nearest * kSlotRows].x) & kStateMask) == kAccepted;
        if (is_known) {
            break;
        }
        from = nearest + 1u;
        nearest = slot;
        cursor = 0u;
    }
    if (is_known) {
        slots[row].y = kSlotCounted;
        add_to_histogram(calls);
        atomicAdd(control.undecided, 0xffffffffu);
    } else {
        slots[row].y = kSlotCounting;
        slots[row + 3u].yzw = uvec3(cursor, nearest, from);
    }
    atomicExchange(blockers[slot], is_known ? calls | kCallsKnown : calls);
}
