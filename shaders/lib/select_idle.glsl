// Fills the slots for the next batch (paper section 4.2): all idle candidates below some order, or
// samples of earlier chunks, whose disks reject candidates of this one. Idle candidates are in a list by
// ranges of their orders, which a separate dispatch fills from time to time. A work group gets a range
// (or all of them, if few slots must be filled exactly), or kSelectBlock candidates or samples. The last
// group to finish prepares the next step. Needs sample_at(place, order), the four words of a sample, and
// settle_point(slot, record).
#ifndef GEODISK_SELECT_IDLE_GLSL
#define GEODISK_SELECT_IDLE_GLSL

layout(local_size_x = kSelectLanes) in;

GEODISK_WORDS_BEFORE(kBindOrders, kBindOrdersTexels, orders);
GEODISK_BUFFER(kBindSamples, readonly, uvec4, samples);
GEODISK_CONTROL;

#include "quotient.glsl"
#include "schedule.glsl"
#include "states.glsl"

shared uint group_places[kListRange]; // of candidates that are due
shared uint group_orders[kListRange];
shared uint group_due;
shared uint group_slot;               // of the first of them

void fill_slot(uint slot, uint place, uvec4 record) {
    slots[slot] = SlotRec(place, kSlotReady, 0u, 0u, record.x, record.y, record.z, record.w, 0u, 0u,
                          0u, 0u, 0u, 0u, 0u, 0u);
}

void select_settled(uint begin) {
    uint taken = min(push.slots, control.settled - control.next_sample);
    uint end = min(begin + kSelectBlock, taken);
    for (uint slot = begin + gl_LocalInvocationID.x; slot < end; slot += kSelectLanes) {
        uvec4 record = samples[control.next_sample + slot];
        fill_slot(slot, kNoPlace, record);
        settle_point(slot, record);
    }
    if (begin == 0u && gl_LocalInvocationID.x == 0u) {
        atomicAdd(control.due, taken);
    }
}

// Returns true if the candidate is idle. While a batch is selected, only candidates of that batch are
// active.
bool is_idle(uint place) {
    return (word_before(orders, undecided_word(place)) & state_bit(place)) != 0u;
}

void list_one(uint place, uint order, uint range) {
    uint head = list_head(range);
    uint at = atomicAdd(list[head], 1u);
    if (at < kListRange) {
        list[head + 1u + at] = place;
    } else {
        atomicMin(control.list_left, order);
    }
}

// Lists the idle candidates of a block of all candidates, 32 per invocation at a time.
void list_idle(uint begin) {
    uint end = min(begin + kSelectBlock, control.drawn);
    uint first_order = control.list_first;
    uint list_end = control.list_end;
    uint width = control.list_width;
    uint inverse = inverse_of(width);
    for (uint first = begin + 32u * gl_LocalInvocationID.x; first < end; first += 32u * kSelectLanes) {
        uint idle = word_before(orders, undecided_word(first));
        uint listed = 0u;
        while (idle != 0u) {
            uint bit = uint(findLSB(idle));
            idle &= idle - 1u;
            uint order = word_before(orders, first + bit);
            listed |= order >= first_order && order < list_end ? 1u << bit : 0u;
        }
        while (listed != 0u) {
            uint place = first + uint(findLSB(listed));
            listed &= listed - 1u;
            uint order = word_before(orders, place);
            list_one(place, order, quotient(order - first_order, width, inverse));
        }
    }
}

// Finds the candidates of a range of the list that are due.
void find_due(uint head) {
    uint first_order = control.first_order;
    uint batch_end = control.batch_end;
    uint count = min(list[head], kListRange);
    uint first = head + 1u + gl_LocalInvocationID.x;
    uint bits = 0u;
    for (uint i = 0u; i * kSelectLanes + gl_LocalInvocationID.x < count; ++i) {
        uint place = list[first + i * kSelectLanes];
        uint order = word_before(orders, place);
        bool is_due = order >= first_order && order < batch_end && is_idle(place);
        bits |= is_due ? 1u << i : 0u;
    }
    uint at = atomicAdd(group_due, uint(bitCount(bits)));
    while (bits != 0u) {
        uint place = list[first + uint(findLSB(bits)) * kSelectLanes];
        uint order = word_before(orders, place);
        if (at < kListRange) {
            group_places[at] = place;
            group_orders[at] = order;
        } else {
            atomicMin(control.first_left, order);
        }
        bits &= bits - 1u;
        ++at;
    }
}

// Returns how many of the candidates that are due come before one of them.
uint rank_among(uint due, uint own) {
    uint rank = 0u;
    for (uint i = 0u; i < due; ++i) {
        bool is_before = group_orders[i] < group_orders[own] ||
                         (group_orders[i] == group_orders[own] && i < own);
        rank += is_before ? 1u : 0u;
    }
    return rank;
}

void give_slots() {
    uint due = min(group_due, kListRange);
    bool is_ordered = is_ranked() || group_slot + due > batch_slots();
    for (uint i = gl_LocalInvocationID.x; i < due; i += kSelectLanes) {
        uint slot = group_slot + (is_ordered ? rank_among(due, i) : i);
        uint place = group_places[i];
        uint order = group_orders[i];
        if (slot < batch_slots()) {
            fill_slot(slot, place, sample_at(place, order));
            atomicOr(orders[active_word(place)], state_bit(place));
            orders[place] = slot;
        } else {
            atomicMin(control.first_left, order);
        }
    }
}

void main() {
    bool is_first = gl_LocalInvocationID.x == 0u;
    uint group = gl_WorkGroupID.x;
    uint mode = control.mode;
    if (is_first) {
        group_due = 0u;
    }
    barrier();
    if (mode == kSelectSettled) {
        select_settled(group * kSelectBlock);
    } else if (mode == kSelectPool) {
        list_idle((control.listed_blocks + group) * kSelectBlock);
    } else {
        uint ranges = is_ranked() ? due_ranges() : 1u;
        for (uint i = 0u; i < ranges; ++i) {
            find_due(list_head(control.first_range + group + i));
        }
    }
    barrier();
    if (is_first) {
        group_slot = atomicAdd(control.due, group_due);
    }
    barrier();
    give_slots();
    memoryBarrierBuffer();
    barrier();
    bool is_last =
        is_first && atomicAdd(control.selected_groups, 1u) == gl_NumWorkGroups.x - 1u;
    memoryBarrierBuffer();
    if (is_last) {
        go_on_selected();
    }
}

#endif
