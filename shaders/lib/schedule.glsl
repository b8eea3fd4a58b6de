// Schedule: which candidates come next, and when a run is done. It does not affect the samples: a batch
// always contains all idle candidates up to some order.
#ifndef GEODISK_SCHEDULE_GLSL
#define GEODISK_SCHEDULE_GLSL

#include "job.glsl"

layout(constant_id = kSpecSlotLocalSize) const uint kSlotLocalSize = 64u;

GEODISK_BUFFER(kBindList, , uint, list);

// Average share of the places in the list of idle candidates that is filled: less where surfaces draw alike,
// since their candidates come in crowds.
const float kListFill = 0.75;
const float kListFillAlike = 0.375;
// Other disks of a batch are to take this part of the time of its largest one at least, if slots last. More
// would be in vain too often.
const float kBusyPart = 0.5;
// A list that holds less than this part of its orders is made again, of fewer orders.
const uint kListPart = 8u;

uint groups_of_slots(uint count) { return (count + kSlotLocalSize - 1u) / kSlotLocalSize; }

// Returns the number of ranges of orders in the list.
uint list_ranges() { return (job.idle_capacity + kListRange - 1u) / kListRange; }
// Returns where a range begins in the list: its count, then its places.
uint list_head(uint range) { return range * (kListRange + 1u); }

uint range_of(uint order) { return (order - control.list_first) / control.list_width; }
// Returns the number of ranges of the batch.
uint due_ranges() { return range_of(control.batch_end - 1u) - control.first_range + 1u; }

// Returns the order up to which this many idle candidates are expected, from `first` on. Disks reject
// candidates whatever their order.
uint order_after(uint first, float idle) {
    uint end = (push.stages << kPriorityBits) + job.max_lag;
    precise float spacing = float(end - first) / max(float(control.idle), 1.0);
    precise float ahead = idle * spacing;
    float left = float(push.end_order - first);
    return ahead >= left ? push.end_order : first + max(uint(ahead), 1u);
}

// Returns true if exactly the first candidates that are due get the slots.
bool is_ranked() { return push.slots <= kMaxRanked; }

// Returns so many slots that lanes are busy for a part of the time of the largest disk so far. Returns 0 where a
// work group computes a disk together, and after settled samples, whose disks are no measure for others.
uint slots_beside_largest() {
    if (push.lanes_per_group == 1u || control.settled > 0u) {
        return 0u;
    }
    precise float windows = float(control.windows_high) * 4294967296.0 + float(control.windows_low);
    precise float usual = windows / max(float(control.disks), 1.0);
    precise float slots = kBusyPart * float(push.lanes) * float(control.max_windows) / max(usual, 1.0);
    return uint(min(slots, float(push.slots)));
}

// Returns the slots for the next batch: all of them if it is for candidates of a single order.
uint batch_slots() {
    return control.longest_span == 1u ? push.slots : max(slots_beside_largest(), push.batch);
}

// Returns the number of idle candidates to aim at: if ranked, so many that mostly all slots are filled;
// else so few that mostly all find a slot, since one without a slot cuts the batch short.
float wanted_idle() {
    precise float batch = float(batch_slots());
    precise float deviation = sqrt(batch);
    precise float wanted = batch + (is_ranked() ? 3.0 : -1.5) * deviation;
    return wanted;
}

// Returns an order below which this many idle candidates are expected, from `first` on.
uint end_after(uint first, float idle) {
    return first + min(order_after(first, idle) - first, control.longest_span);
}

// Prepares select for all candidates, to list the idle ones from `first` on again.
void prepare_list(uint first) {
    uint ranges = list_ranges();
    float fill = job.max_lag > 0u ? kListFillAlike : kListFill;
    precise float filled = fill * float(ranges * kListRange);
    control.list_end = end_after(first, filled);
    control.list_first = first;
    control.list_width = (control.list_end - first - 1u) / ranges + 1u;
    control.list_left = kNoOrder;
    control.listed_blocks = 0u;
    for (uint range = 0u; range < ranges; ++range) {
        list[list_head(range)] = 0u;
    }
}

// Returns the blocks of candidates for the next select that fills the list.
uint next_blocks() {
    uint blocks = (control.drawn + kSelectBlock - 1u) / kSelectBlock;
    return min(blocks - control.listed_blocks, push.list_groups);
}

// Prepares only select, with this many work groups.
void set_out_select(uint groups) {
    control.selected_groups = 0u;
    control.select_x = groups;
    control.select_y = 1u;
    control.select_z = 1u;
    control.detect_x = 0u;
    control.large_x = 0u;
    control.groups_x = 0u;
}

// Prepares select for the batch after first_order.
void prepare_select() {
    uint first = control.first_order;
    uint groups;
    if (control.next_sample < control.settled) {
        control.mode = kSelectSettled;
        groups = (push.slots + kSelectBlock - 1u) / kSelectBlock;
    } else {
        uint end = end_after(first, wanted_idle());
        bool is_fresh = control.list_first == first && control.list_end > first;
        if (end > control.list_end && !is_fresh) {
            control.mode = kSelectPool;
            prepare_list(first);
            groups = next_blocks();
        } else {
            control.mode = kSelectList;
            control.batch_end = min(end, control.list_end);
            control.first_range = range_of(first);
            if (is_ranked()) {
                uint range_end = control.list_first +
                                 (control.first_range + kMaxRangesRanked) * control.list_width;
                control.batch_end = range_end > first ? min(control.batch_end, range_end)
                                                      : control.batch_end;
            }
            groups = is_ranked() ? 1u : due_ranges();
        }
    }
    control.first_left = kNoOrder;
    control.due = 0u;
    control.slots_used = 0u;
    set_out_select(groups);
}

// Prepares the next step, if there is one and there is room for its samples.
void go_on() {
    bool is_enough = control.accepted >= job.stop_count || control.drawn == 0u;
    bool settled = control.next_sample < control.settled;
    if (is_enough || (!settled && control.first_order >= push.end_order)) {
        control.done = 1u;
    } else if (control.accepted + push.slots > push.sample_capacity) {
        atomicOr(control.overflow, kOverflowSamples);
    } else {
        prepare_select();
    }
}

// Continues after a batch that is decided or was empty.
void end_batch() {
    if (control.mode == kSelectSettled) {
        control.next_sample += control.slots_used;
    } else {
        control.first_order = min(control.batch_end, control.first_left);
    }
    set_out_select(0u);
    control.slots_used = 0u;
    go_on();
}

// Shortens the next batch if not even the first candidate found room.
void limit_batch() {
    bool is_stuck = control.first_left <= control.first_order;
    uint span = control.batch_end - control.first_order;
    control.longest_span = is_stuck ? max(span / 2u, 1u) : kNoOrder;
}

// Ends the list where candidates found no room. If that is soon, makes a list of fewer orders: in a crowd,
// room is found by narrower ranges.
void limit_list() {
    uint span = control.list_end - control.first_order;
    uint listed = max(control.list_left, control.first_order) - control.first_order;
    bool is_short = listed < span && listed <= span / kListPart;
    uint fewer = min(max(2u * listed, control.list_width), max(span / 2u, 1u));
    control.longest_span = is_short ? fewer : kNoOrder;
    control.list_end = is_short ? control.first_order : min(control.list_end, control.list_left);
}

// Begins the batch that select has put into the slots.
void begin_batch() {
    uint most = control.mode == kSelectSettled ? push.slots : batch_slots();
    uint used = min(control.due, most);
    control.select_x = 0u;
    limit_batch();
    if (used == 0u) {
        end_batch();
        return;
    }
    control.slots_used = used;
    control.next_slot = 0u;
    control.large = 0u;
    control.next_large = 0u;
    control.incomplete = used;
    control.undecided = used;
    control.next_ordered = control.accepted;
    control.batches += 1u;
    control.groups_x = groups_of_slots(used);
    control.groups_y = 1u;
    control.groups_z = 1u;
    uint lanes = min(used, push.lanes);
    control.detect_x = (lanes + push.lanes_per_group - 1u) / push.lanes_per_group;
    control.detect_y = 1u;
    control.detect_z = 1u;
}

// Continues after select: with a batch from the list that it has filled, or the batch that it has put
// into the slots.
void go_on_selected() {
    if (control.mode == kSelectPool) {
        control.listed_blocks += control.select_x;
        if (next_blocks() > 0u) {
            set_out_select(next_blocks());
            return;
        }
        limit_list();
        go_on(); // push.end_order may be lower by now.
    } else {
        begin_batch();
    }
}

// Begins a chunk with this many candidates.
void begin_chunk(uint drawn) {
    control.abi = kAbi;
    control.drawn = drawn;
    control.next_ordered = control.accepted;
    if (drawn > job.capacity) {
        atomicOr(control.overflow, kOverflowCandidates);
        return;
    }
    control.idle = drawn;
    control.longest_span = kNoOrder;
    control.first_order = 0u;
    control.list_end = 0u;
    control.next_sample = 0u;
    go_on();
}

#endif
