#version 450
#extension GL_GOOGLE_include_directive : require
// Hands out the slots once the batch before is decided (paper section 4.2): first to the samples of
// earlier chunks, for their disks to reject the chunk's candidates, then to the lowest-ranked idle
// candidates. One work group; it may stop early, since how many are active never matters.
// reads: samples (ranks), sums (idle bits)   writes: slots, control   spec: local size, count calls

#include "../lib/prelude.glsl"
#include "../lib/group_scan.glsl"

layout(local_size_x = 128) in;
layout(constant_id = kSpecLocalSize) const uint kSlotLocalSize = 64u;
layout(constant_id = kSpecCountCalls) const bool kCountCalls = false;

GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_WORDS(kBindSums, idle);
GEODISK_BUFFER(kBindSamples, readonly, uvec4, samples);
GEODISK_CONTROL;

shared uint first_left; // lowest idle rank that found no slot

void fill_slot(uint slot, uint rank) {
    slots[slot * kSlotRows].y = kSlotSelected;
    slots[slot * kSlotRows + 1u].x = rank;
}

// Slots for the settled samples from `first` on; how many.
uint select_samples(uint lane, uint first) {
    uint taken = min(push.slots, control.settled - first);
    for (uint slot = lane; slot < taken; slot += kScanLanes) {
        fill_slot(slot, samples[first + slot].x - push.first_rank);
    }
    barrier();
    return taken;
}

// At most `slots_left` slots for the idle candidates from rank `batch` on; how many. `next` is the
// first rank not yet looked at.
uint select_idle(uint lane, uint batch, uint slots_left, out uint next) {
    uint words = control.find_x * kFindLanes; // found since
    uint taken = 0u;
    next = batch;
    if (lane == 0u) {
        first_left = push.candidates;
    }
    barrier();
    for (uint first = 0u; first < words; first += kScanLanes) {
        uint word = first + lane;
        uint bits = word < words ? word_at(idle, word) : 0u;
        uint total;
        uint slot = taken + group_exclusive_scan(lane, uint(bitCount(bits)), total);
        while (bits != 0u) {
            uint rank = batch + 32u * word + uint(findLSB(bits));
            if (slot >= slots_left) {
                atomicMin(first_left, rank);
                break;
            }
            fill_slot(slot, rank);
            ++slot;
            bits &= bits - 1u;
        }
        barrier();
        taken = min(taken + total, slots_left);
        uint seen = batch + 32u * min(first + kScanLanes, words);
        next = min(min(seen, push.candidates), first_left);
        if (taken == slots_left || next == push.candidates) {
            break;
        }
    }
    return taken;
}

// The groups of find_idle that the next batch needs: it will have to look a little further than this
// one, since fewer are idle.
uint groups_to_find(uint batch, uint next) {
    uint expected = max(next - batch, push.slots) + (next - batch) / 2u;
    uint ahead = min(expected, push.candidates - next);
    uint groups = (ahead + 32u * kFindLanes - 1u) / (32u * kFindLanes);
    return min(groups, kFindMostGroups);
}

uint groups_of_slots(uint count) { return (count + kSlotLocalSize - 1u) / kSlotLocalSize; }

void main() {
    // The same for all lanes: nothing writes them before the last barrier.
    if (control.undecided > 0u || control.overflow != 0u || control.done != 0u) {
        return;
    }
    uint lane = gl_LocalInvocationID.x;
    uint batch = control.next_rank;
    uint batch_sample = control.next_sample;
    // A batch never accepts more than it takes, so the run stops at just the count asked for.
    uint wanted = push.stop_count - control.accepted;
    uint taken = 0u;
    uint next = batch;
    bool settled = batch_sample < control.settled;
    if (settled) {
        taken = select_samples(lane, batch_sample);
    } else {
        taken = select_idle(lane, batch, min(push.slots, wanted), next);
    }
    if (lane == 0u) {
        control.abi = kAbi;
        control.batch_rank = batch;
        control.next_rank = next;
        control.batch_sample = batch_sample;
        control.next_sample = batch_sample + (settled ? taken : 0u);
        control.slots_used = taken;
        control.next_slot = 0u;
        control.incomplete = taken;
        control.unfinished = taken;
        control.undecided = kCountCalls && !settled ? 2u * taken : taken;
        control.iterations += taken > 0u ? 1u : 0u;
        control.done = taken == 0u && (next == push.candidates || wanted == 0u) ? 1u : 0u;
        control.groups_x = groups_of_slots(taken);
        control.groups_y = 1u;
        control.groups_z = 1u;
        control.find_x = settled ? 0u : groups_to_find(batch, next);
        control.find_y = 1u;
        control.find_z = 1u;
        control.detect_x = groups_of_slots(min(taken, push.lanes));
        control.detect_y = 1u;
        control.detect_z = 1u;
    }
}
