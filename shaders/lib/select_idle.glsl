// Readies the slots for the next batch (paper section 4.2): all idle candidates below some order, or
// samples of earlier chunks, whose disks are to reject candidates of this one. kSelectBlock entries of
// the pool, of the list, or of the samples to a work group; the last group to be done begins the batch.
// Needs sample_at(place, order), the four words of a sample, and settle_point(slot, record).
#ifndef GEODISK_SELECT_IDLE_GLSL
#define GEODISK_SELECT_IDLE_GLSL

layout(local_size_x = kWideLanes) in;

GEODISK_BUFFER(kBindStates, , uint, states);
GEODISK_BUFFER(kBindOrders, , uint, orders);
GEODISK_BUFFER(kBindList, , uint, list);
GEODISK_BUFFER(kBindSamples, readonly, uvec4, samples);
GEODISK_CONTROL;

#include "schedule.glsl"

shared uint group_waiting;

void fill_slot(uint slot, uint place, uvec4 record) {
    slots[slot] = SlotRec(place, kSlotReady, 0u, 0u, record.x, record.y, record.z, record.w, 0u, 0u,
                          0u, 0u, 0u, 0u, 0u, 0u);
}

void select_settled(uint begin) {
    uint taken = min(push.slots, control.settled - control.next_sample);
    uint end = min(begin + kSelectBlock, taken);
    for (uint slot = begin + gl_LocalInvocationID.x; slot < end; slot += kWideLanes) {
        uvec4 record = samples[control.next_sample + slot];
        fill_slot(slot, kNoPlace, record);
        settle_point(slot, record);
    }
    if (begin == 0u && gl_LocalInvocationID.x == 0u) {
        atomicAdd(control.due, taken);
    }
}

uint place_at(uint index) { return control.mode == kSelectPool ? index : list[2u * index]; }

void give_slots(uint first, uint bits) {
    if (bits == 0u) {
        return;
    }
    uint slot = atomicAdd(control.due, uint(bitCount(bits)));
    while (bits != 0u) {
        uint place = place_at(first + uint(findLSB(bits)) * kWideLanes);
        uint order = orders[place];
        bits &= bits - 1u;
        if (slot < push.slots) {
            fill_slot(slot, place, sample_at(place, order));
            states[place] |= kActive;
            orders[place] = slot;
        } else {
            atomicMin(control.first_left, order);
        }
        ++slot;
    }
}

void list_idle(uint first, uint bits) {
    if (bits == 0u) {
        return;
    }
    uint at = atomicAdd(control.list_count, uint(bitCount(bits)));
    while (bits != 0u) {
        uint place = first + uint(findLSB(bits)) * kWideLanes;
        bits &= bits - 1u;
        if (at < push.idle_capacity) {
            list[2u * at] = place;
            list[2u * at + 1u] = orders[place];
        } else {
            atomicMin(control.list_left, orders[place]);
        }
        ++at;
    }
}

void select_idle(uint begin) {
    bool from_pool = control.mode == kSelectPool;
    uint count = from_pool ? control.drawn : control.list_count;
    uint first = begin + gl_LocalInvocationID.x;
    uint first_order = control.first_order;
    uint batch_end = control.batch_end;
    uint last = from_pool ? control.list_end : batch_end;
    uint due = 0u;
    uint idle = 0u;
    uint end = min(begin + kSelectBlock, count);
    uint bit = 1u;
    for (uint index = first; index < end; index += kWideLanes) {
        // States lie far apart, so only those that matter are looked at.
        uint order = from_pool ? orders[index] : list[2u * index + 1u];
        if (order >= first_order && order < last) {
            uint place = from_pool ? index : list[2u * index];
            bool is_idle = (states[place] & kStateMask) == kIdle;
            idle |= is_idle ? bit : 0u;
            due |= is_idle && order < batch_end ? bit : 0u;
        }
        bit <<= 1;
    }
    if (from_pool) {
        list_idle(first, idle);
    }
    atomicAdd(group_waiting, uint(bitCount(idle & ~due)));
    give_slots(first, due);
}

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        group_waiting = 0u;
    }
    barrier();
    uint begin = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kSelectBlock;
    if (control.mode == kSelectSettled) {
        select_settled(begin);
    } else {
        select_idle(begin);
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        atomicAdd(control.waiting, group_waiting);
    }
    memoryBarrierBuffer();
    barrier();
    uint groups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    bool is_last = gl_LocalInvocationID.x == 0u &&
                   atomicAdd(control.selected_groups, 1u) == groups - 1u;
    memoryBarrierBuffer();
    if (is_last) {
        begin_batch();
    }
}

#endif
