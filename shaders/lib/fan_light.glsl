// Which corners of a vertex's fan are lit by a path that ends at the vertex.
#ifndef GEODISK_FAN_LIGHT_GLSL
#define GEODISK_FAN_LIGHT_GLSL

#include "fans.glsl"
#include "job.glsl"

// Half-edge and angles of a corner of the fans.
uvec2 fan_corner(uint i) {
    uvec4 row = row_at(fans, job.vertices + (i >> 1));
    return (i & 1u) == 0u ? row.xy : row.zw;
}

uint corner_angles(uint h) {
    uint corners = 3u * job.faces;
    return row_at(fans, job.vertices + ((corners + 1u) >> 1) + (h >> 2))[h & 3u];
}

// Whether a shortest path that came in through corner entered_by may go on into `corner`: it must
// keep an angle of pi on both sides, or on one side of an open fan.
bool in_shadow(uvec2 corner) {
    if (lane.entered_by == kWholeFan || (lane.fan_flags & kFanIrregular) != 0u) {
        return true;
    }
    uint from_start = lane.entry_angles & 0xffffu;
    uint from_end = from_start + (lane.entry_angles >> 16);
    uint start = corner.y & 0xffffu;
    uint end = start + (corner.y >> 16);
    uint turned_left = end - from_start;
    uint turned_right = from_end - start;
    // In steps of angles a needle may begin where its neighbour does: either may be the first.
    bool is_other = corner.x != lane.entered_by;
    bool may_come_before = start < from_start || (start == from_start && is_other);
    bool may_come_behind = start >= from_start;
    uint needed = kAnglePi - kAngleTolerance;
    if ((lane.fan_flags & kFanOpen) != 0u) {
        return (may_come_before && turned_right >= needed) ||
               (may_come_behind && turned_left >= needed);
    }
    uint around = is_other ? lane.fan_angle : 0u;
    return (may_come_before && turned_left + around >= needed && turned_right >= needed) ||
           (may_come_behind && turned_left >= needed && turned_right + around >= needed);
}

#endif
