#version 450
#extension GL_GOOGLE_include_directive : require
// Hands the slots to the lowest-ranked idle candidates, as many as there are slots, once the batch
// before is decided (paper section 4.2). One work group; it may stop early, since how many are
// active never matters.
// reads: sums (idle bits)   writes: slots, control   spec: local size

#include "../lib/prelude.glsl"
#include "../lib/group_scan.glsl"

layout(local_size_x = 128) in;
layout(constant_id = kSpecLocalSize) const uint kSlotLocalSize = 64u;

GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_WORDS(kBindSums, idle);
GEODISK_CONTROL;

shared uint first_left; // lowest idle rank that found no slot

void main() {
    // The same for all lanes: nothing writes them before the last barrier.
    if (control.undecided > 0u || control.overflow != 0u || control.done != 0u) {
        return;
    }
    uint lane = gl_LocalInvocationID.x;
    uint batch = control.next_rank;
    uint words = control.find_x * kFindLanes; // found since
    uint next = batch;
    uint taken = 0u;
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
            if (slot >= push.slots) {
                atomicMin(first_left, rank);
                break;
            }
            slots[slot * kSlotRows].y = kSlotSelected;
            slots[slot * kSlotRows + 1u].x = rank;
            ++slot;
            bits &= bits - 1u;
        }
        barrier();
        taken = min(taken + total, push.slots);
        uint seen = batch + 32u * min(first + kScanLanes, words);
        next = min(min(seen, push.candidates), first_left);
        if (taken == push.slots || next == push.candidates) {
            break;
        }
    }
    if (lane == 0u) {
        control.abi = kAbi;
        control.batch_rank = batch;
        control.next_rank = next;
        control.slots_used = taken;
        control.next_slot = 0u;
        control.unfinished = taken;
        control.undecided = taken;
        control.iterations += taken > 0u ? 1u : 0u;
        control.done = taken == 0u && next == push.candidates ? 1u : 0u;
        control.groups_x = (taken + kSlotLocalSize - 1u) / kSlotLocalSize;
        control.groups_y = 1u;
        control.groups_z = 1u;
        // The next batch will have to look a little further than this one, since fewer are idle.
        uint expected = max(next - batch, push.slots) + (next - batch) / 2u;
        uint ahead = min(expected, push.candidates - next);
        uint groups = (ahead + 32u * kFindLanes - 1u) / (32u * kFindLanes);
        control.find_x = min(groups, kFindMostGroups);
        control.find_y = 1u;
        control.find_z = 1u;
    }
}
