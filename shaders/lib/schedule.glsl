// Which candidates are looked at next, and when a run is done. Nothing of it bears on the samples: the
// candidates of a batch are always all idle ones up to some order.
#ifndef GEODISK_SCHEDULE_GLSL
#define GEODISK_SCHEDULE_GLSL

layout(constant_id = kSpecLocalSize) const uint kSlotLocalSize = 64u;

// Of the list of idle candidates, filled on average.
const float kListFill = 0.8;

uint groups_of_slots(uint count) { return (count + kSlotLocalSize - 1u) / kSlotLocalSize; }

// The order up to which so many idle candidates are expected, from `order` on.
uint order_after(uint order, float idle) {
    precise float ahead = idle * control.spacing;
    float left = float(push.end_order - order);
    return ahead >= left ? push.end_order : order + max(uint(ahead), 1u);
}

// So few that mostly all of them find a slot: one that finds none cuts the batch short.
float wanted_idle() {
    precise float wanted = float(push.slots) - 1.5 * sqrt(float(push.slots));
    return wanted;
}

// Sets the next select out on the batch after first_order.
void prepare_select() {
    bool settled = control.next_sample < control.settled;
    uint first = control.first_order;
    uint mode = settled ? kSelectSettled : (first < control.list_end ? kSelectList : kSelectPool);
    if (mode == kSelectPool) {
        control.list_end = order_after(first, kListFill * float(push.idle_capacity));
        control.list_count = 0u;
        control.list_left = kNoOrder;
    }
    control.mode = mode;
    control.batch_end = min(order_after(first, wanted_idle()), control.list_end);
    control.first_left = kNoOrder;
    control.due = 0u;
    control.waiting = 0u;
    control.selected_groups = 0u;
    control.slots_used = 0u;
    uint count = mode == kSelectSettled ? push.slots
                                        : (mode == kSelectList ? control.list_count : control.drawn);
    // One at least: it also goes on where the list is empty.
    uint groups = max((count + kSelectBlock - 1u) / kSelectBlock, 1u);
    uint rows = (groups + 65534u) / 65535u;
    control.select_x = (groups + rows - 1u) / rows;
    control.select_y = rows;
    control.select_z = 1u;
    control.detect_x = 0u;
    control.groups_x = 0u;
    control.count_x = 0u;
}

// Sets out what comes next, if anything does and there is room for its samples.
void go_on() {
    bool is_enough = control.accepted >= push.stop_count || control.drawn == 0u;
    bool settled = control.next_sample < control.settled;
    if (is_enough || (!settled && control.first_order >= push.end_order)) {
        control.done = 1u;
    } else if (control.accepted + push.slots > push.sample_capacity) {
        atomicOr(control.overflow, kOverflowSamples);
    } else {
        prepare_select();
    }
}

// Goes on behind a batch that is decided, or was empty.
void end_batch() {
    if (control.mode == kSelectSettled) {
        control.next_sample += control.slots_used;
    } else {
        control.first_order = min(control.batch_end, control.first_left);
    }
    control.select_x = 0u;
    control.groups_x = 0u;
    control.count_x = 0u;
    control.slots_used = 0u;
    go_on();
}

// Begins the batch that select has put into the slots.
void begin_batch() {
    bool settled = control.mode == kSelectSettled;
    uint used = min(control.due, push.slots);
    control.select_x = 0u;
    if (!settled) {
        control.list_count = min(control.list_count, push.idle_capacity);
        control.list_end = min(control.list_end, control.list_left);
        // By those just listed, or else by the batch. Where too many were due, the next one ends before
        // this one.
        bool is_listed = control.mode == kSelectPool && control.due <= push.slots;
        uint idle = control.due + (is_listed ? control.waiting : 0u);
        uint end = is_listed ? max(control.list_end, control.batch_end) : control.batch_end;
        float span = float(end - control.first_order);
        precise float spacing = span / max(float(idle), 0.5);
        control.spacing = spacing;
    }
    if (used == 0u) {
        end_batch();
        return;
    }
    control.slots_used = used;
    control.next_slot = 0u;
    control.incomplete = used;
    control.undecided = used;
    control.uncounted = used;
    control.next_ordered = control.accepted;
    control.iterations += 1u;
    control.groups_x = groups_of_slots(used);
    control.groups_y = 1u;
    control.groups_z = 1u;
    control.detect_x = groups_of_slots(min(used, push.lanes));
    control.detect_y = 1u;
    control.detect_z = 1u;
    control.count_y = 1u;
    control.count_z = 1u;
}

// Begins a chunk with so many candidates.
void begin_chunk(uint drawn) {
    control.abi = kAbi;
    control.drawn = drawn;
    control.next_ordered = control.accepted;
    if (drawn > push.capacity) {
        atomicOr(control.overflow, kOverflowCandidates);
        return;
    }
    precise float spacing =
        float(push.stages << kPriorityBits) / max(float(drawn), 0.5);
    control.spacing = spacing;
    control.first_order = 0u;
    control.list_end = 0u;
    control.next_sample = 0u;
    go_on();
}

#endif
