#version 450
#extension GL_GOOGLE_include_directive : require
// Decides the active batch (paper CheckStatus, without recursion). A candidate without an undecided one
// before it that blocks it is accepted, and rejects the candidates in its disk. A rejected one removes
// its blocks. The invocation that removes the last block of another candidate, or is the first accepted
// one that blocks it, continues with that one. Blocks only decrease and rejections only increase, so
// every order of events gives the same result. A sample of an earlier chunk is already accepted: nothing
// blocks it, and it only rejects. One invocation per slot; resumable, since lists may be long.
// reads: pool lists   writes: orders, accepted, control, slots   spec: local size, pool block

#include "../lib/prelude.glsl"

layout(local_size_x_id = 4) in; // kSpecSlotLocalSize

GEODISK_BUFFER(kBindOrders, coherent, uint, orders);
GEODISK_ROWS(kBindPool, pool);
GEODISK_BUFFER(kBindAccepted, writeonly, uvec4, accepted);
GEODISK_CONTROL;

#include "../lib/schedule.glsl"
#include "../lib/slice.glsl"
#include "../lib/conflicts.glsl"
#include "../lib/slots.glsl"
#include "../lib/states.glsl"

// Candidates that this invocation will decide.
uint at_hand[kMaxAtHand];
uint hands;
uint decided; // by this invocation
uint fewer;   // idle or active candidates

// Takes a candidate that is not blocked any more, or blocked for good. Without room, it waits for its
// own invocation.
void take_up(uint slot) {
    if (hands < kMaxAtHand) {
        at_hand[hands] = slot;
        ++hands;
    }
}

// Returns true for one invocation only: the first that finds the slot ready or suspended. All
// communication between them is in the word that is claimed.
bool claim(uint slot, out uint cursor) {
    cursor = 0u;
    uint blocks = atomic_load(slots[slot].blocks);
    if ((blocks & kBlockedForGood) == 0u && (blocks & kBlocksMask) != 0u) {
        return false;
    }
    if ((atomicOr(slots[slot].blocks, kClaimed) & kClaimed) == 0u) {
        return true;
    }
    uint left = atomicAnd(slots[slot].cursor, ~kSuspended);
    cursor = left & ~kSuspended;
    return (left & kSuspended) != 0u;
}

// Applies a decision to an active conflict after it in dart order.
void tell(uint other, bool is_rejected) {
    if (is_rejected) {
        uint before = atomicAdd(slots[other].blocks, 0xffffffffu);
        if ((before & kBlocksMask) == 1u && (before & kBlockedForGood) == 0u) {
            take_up(other);
        }
    } else if ((atomicOr(slots[other].blocks, kBlockedForGood) & kBlockedForGood) == 0u) {
        take_up(other);
    }
}

// Accepts or rejects a candidate. It may be rejected several times.
void end_undecided(uint place) {
    uint bit = state_bit(place);
    bool is_first = (atomicAnd(orders[undecided_word(place)], ~bit) & bit) != 0u;
    fewer += is_first ? 1u : 0u;
}

// Handles a conflict that was active when it was listed. Its order word is its slot, or again its order
// once it is decided or was found void, which means idle.
void meet(uvec4 own, uint place, bool is_rejected) {
    uint word = orders[place];
    bool is_slot = word < control.slots_used && slots[word].place == place;
    uint order = is_slot ? slots[word].order : word;
    if (order >= control.first_left) {
        if (!is_rejected) {
            end_undecided(place);
        }
    } else if (is_slot && is_before(own, sample_of(word))) {
        tell(word, is_rejected);
    }
}

void end_active(uint place) { atomicAnd(orders[active_word(place)], ~state_bit(place)); }

// Notes chains of samples alone: which other candidates get a disk depends on the slots, and the
// guard must not.
void note_chain(uint slot) {
    if (slots[slot].longest_chain > control.longest_chain) {
        atomicMax(control.longest_chain, slots[slot].longest_chain);
    }
}

// A candidate whose disk does not end is an error once nothing rejects it.
void check_disk(uint slot) {
    if (slots[slot].longest_chain == kEndless) {
        atomicMax(control.endless_face, slots[slot].face + 1u);
        atomicOr(control.overflow, kOverflowEndless);
    }
}

void finish(uint slot, bool is_rejected) {
    uint place = slots[slot].place;
    slots[slot].phase = kSlotDecided;
    ++decided;
    if (!is_rejected) {
        check_disk(slot);
    }
    if (place == kNoPlace) {
        note_chain(slot);
        return;
    }
    end_undecided(place);
    end_active(place);
    orders[place] = slots[slot].order;
    if (!is_rejected) {
        // A batch begins only if there is room.
        accepted[atomicAdd(control.accepted, 1u)] = sample_of(slot);
        note_chain(slot);
    }
}

// Continues with a slot for at most `budget` list entries; returns the unused budget. Deciding one takes
// at least one entry.
uint decide(uint slot, uint cursor, uint budget) {
    bool is_rejected = (atomic_load(slots[slot].blocks) & kBlockedForGood) != 0u;
    uint active_count = slots[slot].active_conflicts;
    uint total = active_count + (is_rejected ? 0u : slots[slot].idle_conflicts);
    uint end = min(total, cursor + budget);
    uint left = budget - max(end - cursor, 1u);
    uvec4 own = sample_of(slot);
    for (; cursor < min(end, active_count); ++cursor) {
        meet(own, active_conflict(slot, cursor), is_rejected);
    }
    // One row of the list at a time.
    while (cursor < end) {
        uint at = cursor - active_count;
        uvec4 row = list_row_at(slot, at);
        uint next = min(end, cursor + 4u - (at & 3u));
        for (; cursor < next; ++cursor) {
            end_undecided(row[(cursor - active_count) & 3u]);
        }
    }
    if (cursor == total) {
        finish(slot, is_rejected);
    } else {
        atomicExchange(slots[slot].cursor, cursor | kSuspended);
        atomicAdd(control.steps, 1u);
    }
    return left;
}

// Makes a void candidate idle again, unless an accepted one has rejected it meanwhile.
void release(uint slot) {
    uint place = slots[slot].place;
    end_active(place);
    orders[place] = slots[slot].order;
    slots[slot].phase = kSlotDecided;
    ++decided;
}

void decide_from(uint slot) {
    if (is_void(slot)) {
        if (slots[slot].phase != kSlotDecided) {
            release(slot);
        }
        return;
    }
    take_up(slot);
    for (uint budget = kListPerDispatch; hands > 0u && budget > 0u;) {
        --hands;
        uint next = at_hand[hands];
        uint cursor;
        if (claim(next, cursor)) {
            budget = decide(next, cursor, budget);
        }
    }
}

// Memory barriers are where all invocations pass: lavapipe loses atomics around others.
void main() {
    uint slot = gl_GlobalInvocationID.x;
    hands = 0u;
    decided = 0u;
    fewer = 0u;
    if (slot < control.slots_used && control.incomplete == 0u) {
        decide_from(slot);
    }
    if (fewer > 0u) {
        atomicAdd(control.idle, 0u - fewer);
    }
    memoryBarrierBuffer();
    // The invocation that decides the last candidate prepares the next batch.
    bool is_last = decided > 0u && atomicAdd(control.undecided, 0u - decided) == decided;
    memoryBarrierBuffer();
    if (is_last) {
        end_batch();
    }
}
