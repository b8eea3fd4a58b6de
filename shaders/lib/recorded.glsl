// Records of disks, in the buffer of the weights: behind a row with their number, the room for them
// and the row where they begin, and the weights of the targets, if there are any. More than there
// is room for are counted alone.
#ifndef GEODISK_RECORDED_GLSL
#define GEODISK_RECORDED_GLSL

layout(set = 0, binding = kBindWeights, std430) coherent buffer recorded_buffer { uvec4 recorded[]; };

// Counts a record. Returns its number, to write only where has_room(); the count never wraps.
uint count_record() {
    uint at = atomicAdd(recorded[0].x, 1u);
    if (at >= kMaxRecorded) {
        atomicAdd(recorded[0].x, 0xffffffffu);
    }
    return at;
}

bool has_room(uint at) { return at < recorded[0].y; }

// Returns the first row of a record of so many rows.
uint record_row(uint at, uint rows) { return recorded[0].z + rows * at; }

#endif
