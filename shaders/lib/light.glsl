// Records how a disk lights faces, in place of scan.glsl: a LitRec for each operation. The record of a disk of
// another scale has lengths in the unit of the job.
#ifndef GEODISK_LIGHT_GLSL
#define GEODISK_LIGHT_GLSL

#include "job.glsl"
#include "operation.glsl"
#include "recorded.glsl"

const bool kScans = true;

bool scanning() { return false; }

void scan_some() {}

// Returns the limit of the operation in flight for a target without a radius; negative for a point to avoid.
float lit_limit() {
    precise float of_avoided = -path_limit();
    return keeps_out() ? of_avoided : (kAdaptive ? limit_with(0.0) : path_limit());
}

void begin_scan(float sx, float sy) {
    if (own_place != kNoPlace) {
        return; // A candidate, which stands in where a job needs one.
    }
    bool inside = lane.mode == kModeInside;
    uint at = count_record();
    if (!has_room(at)) {
        return;
    }
    precise float back = uintBitsToFloat(0x7f000000u - floatBitsToUint(own_scale));
    vec2 interval = entry_interval();
    precise vec4 source = vec4(sx, sy, interval.x, interval.y) * back;
    precise float sigma = lane.sigma * back;
    precise float limit = lit_limit() * back;
    uint row = record_row(at, 2u);
    recorded[row] =
        uvec4(lane.half_edge << 1 | (inside ? 1u : 0u), control.next_sample + lane.slot,
              floatBitsToUint(sigma), floatBitsToUint(limit));
    recorded[row + 1u] = floatBitsToUint(source);
}

#endif
