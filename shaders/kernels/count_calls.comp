#version 450
#extension GL_GOOGLE_include_directive : require
// Counts calls of the paper's CheckStatus for each candidate of a decided batch (section 5.4): one for
// the candidate, plus the calls of every active conflict before it, in dart order until one is accepted.
// One invocation per slot, which visits its list once for each of those conflicts. Resumable, since
// lists may be long and counts of others not yet known.
// reads: pool lists   writes: orders, slots, control   spec: slot local size, pool block

#include "../lib/prelude.glsl"

layout(local_size_x_id = 12) in; // kSpecSlotLocalSize

GEODISK_BUFFER(kBindOrders, , uint, orders);
GEODISK_ROWS(kBindPool, pool);
GEODISK_CONTROL;

#include "../lib/schedule.glsl"
#include "../lib/slice.glsl"
#include "../lib/conflicts.glsl"
#include "../lib/slots.glsl"

void add_to_histogram(uint calls) {
    atomicAdd(control.call_bins[min(calls, kCallBins) - 1u], 1u);
    GEODISK_ADD_WIDE(control.calls_low, control.calls_high, calls)
}

// While calls are counted, active candidates keep their slots instead of their orders.
void restore_orders() {
    for (uint slot = 0u; slot < control.slots_used; ++slot) {
        uint place = slots[slot].place;
        if (place != kNoPlace) {
            orders[place] = slots[slot].order;
        }
    }
}

// Returns true once the slot's calls are known.
bool count(uint slot) {
    if (is_void(slot)) {
        return true;
    }
    uint listed = slots[slot].active_conflicts;
    uint cursor = 0u;
    uint last = slot;    // counted last; the slot itself means none
    uint nearest = slot; // the first after it, of those that the list shows up to the cursor
    uint calls = 1u;
    if (slots[slot].phase == kSlotCounting) {
        cursor = slots[slot].cursor;
        last = slots[slot].turn;
        nearest = slots[slot].scan_place;
        calls = atomic_load(slots[slot].calls);
    }
    bool is_known = false;
    for (uint entry = 0u; entry < kListPerDispatch; ++entry) {
        if (cursor < listed) {
            uint place = active_conflict(slot, cursor);
            uint other = orders[place];
            ++cursor;
            if (is_slot_of(other, place) && is_before(sample_of(other), sample_of(nearest)) &&
                (last == slot || is_before(sample_of(last), sample_of(other)))) {
                nearest = other;
            }
            continue;
        }
        is_known = nearest == slot;
        uint others = is_known ? 0u : atomic_load(slots[nearest].calls);
        if ((others & kCallsKnown) == 0u) {
            break;
        }
        calls = min(calls + (others & kMostCalls), kMostCalls);
        is_known = (slots[nearest].blocks & kBlockedForGood) == 0u; // accepted
        if (is_known) {
            break;
        }
        last = nearest;
        nearest = slot;
        cursor = 0u;
    }
    if (is_known) {
        add_to_histogram(calls);
        atomicExchange(slots[slot].calls, calls | kCallsKnown);
    } else {
        slots[slot].phase = kSlotCounting;
        slots[slot].cursor = cursor;
        slots[slot].turn = last;
        slots[slot].scan_place = nearest;
        atomicExchange(slots[slot].calls, calls);
        atomicAdd(control.steps, 1u);
    }
    return is_known;
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    bool is_counted = slot < control.slots_used && slots[slot].phase != kSlotCounted && count(slot);
    if (is_counted) {
        slots[slot].phase = kSlotCounted;
    }
    memoryBarrierBuffer();
    bool is_last = is_counted && atomicAdd(control.uncounted, 0xffffffffu) == 1u;
    memoryBarrierBuffer();
    if (is_last) {
        restore_orders();
        end_batch();
    }
}
