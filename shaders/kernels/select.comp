#version 450
#extension GL_GOOGLE_include_directive : require
// Activates the lowest-ranked idle candidates, as many as there are slots, once the batch before is
// decided (paper section 4.2). One work group; it may stop early, since how many are active never
// matters.
// reads: alias columns, places   writes: points, slots, marks, control, blockers

#include "../lib/prelude.glsl"
#include "../lib/candidate.glsl"
#include "../lib/group_scan.glsl"

layout(local_size_x = 128) in;
layout(constant_id = kSpecLocalSize) const uint kDetectLocalSize = 64u;

GEODISK_BUFFER(kBindPlaces, readonly, uint, places);
GEODISK_BUFFER(kBindPoints, , uvec2, points);
GEODISK_BUFFER(kBindSlots, , uvec4, slots);
GEODISK_BUFFER(kBindMarks, writeonly, uint, marks);
GEODISK_CONTROL;

// Blocks of ranks looked at in one dispatch.
const uint kBlocksPerDispatch = 64u;

shared uint first_left; // lowest idle rank that found no slot

void activate(uint slot, uint place, uint rank) {
    Candidate c = draw_candidate(rank);
    uint row = slot * kSlotRows;
    slots[row] = uvec4(place, kPhaseClear, 0u, 0u);
    slots[row + 1u] = uvec4(rank, c.face, floatBitsToUint(weight_of(c.weight1)),
                            floatBitsToUint(weight_of(c.weight2)));
    for (uint i = 2u; i < kSlotRows; ++i) {
        slots[row + i] = uvec4(0u);
    }
    blockers[slot] = 0u;
    marks[place] = slot;
    points[place].x |= kActive;
}

// Idle ranks among [begin, end) as bits.
uint idle_bits(uint begin, uint end) {
    uint bits = 0u;
    for (uint rank = begin; rank < end; ++rank) {
        uint idle = (points[places[rank]].x & kStateMask) == kIdle ? 1u : 0u;
        bits |= idle << (rank - begin);
    }
    return bits;
}

void main() {
    // The same for all lanes: nothing writes them before the last barrier.
    if (control.undecided > 0u || control.overflow != 0u || control.done != 0u) {
        return;
    }
    uint lane = gl_LocalInvocationID.x;
    uint next = control.next_rank;
    uint batch = next;
    uint taken = 0u;
    if (lane == 0u) {
        first_left = push.candidates;
    }
    barrier();
    for (uint block = 0u; block < kBlocksPerDispatch; ++block) {
        uint begin = min(next + lane * kScanPerLane, push.candidates);
        uint end = min(begin + kScanPerLane, push.candidates);
        uint bits = idle_bits(begin, end);
        uint total;
        uint slot = taken + group_exclusive_scan(lane, uint(bitCount(bits)), total);
        while (bits != 0u) {
            uint rank = begin + uint(findLSB(bits));
            if (slot >= push.slots) {
                atomicMin(first_left, rank);
                break;
            }
            activate(slot, places[rank], rank);
            ++slot;
            bits &= bits - 1u;
        }
        barrier();
        taken = min(taken + total, push.slots);
        next = min(min(next + kScanBlock, push.candidates), first_left);
        if (taken == push.slots || next == push.candidates) {
            break;
        }
    }
    if (lane == 0u) {
        control.abi = kAbi;
        control.batch_rank = batch;
        control.next_rank = next;
        control.slots_used = taken;
        control.unfinished = taken;
        control.undecided = taken;
        control.iterations += taken > 0u ? 1u : 0u;
        control.done = taken == 0u && next == push.candidates ? 1u : 0u;
        control.groups_x = (taken + kDetectLocalSize - 1u) / kDetectLocalSize;
        control.groups_y = 1u;
        control.groups_z = 1u;
    }
}
