// The candidate whose disk is computed, and the sources of operations inside a face. Needs scan.glsl or
// light.glsl.
#ifndef GEODISK_SOURCE_GLSL
#define GEODISK_SOURCE_GLSL

#include "lists.glsl"
#include "operation.glsl"
#include "shadow.glsl"

uint own_face;
vec2 own_weights;

void load_candidate(uint slot) {
    own_place = slots[slot].place;
    own_face = slots[slot].face;
    own_weights = uintBitsToFloat(uvec2(slots[slot].weight1, slots[slot].weight2));
    list_first = list_row(slot);
    if (kAdaptive) {
        own_radius = radius_at(face_radii(own_face), own_weights.x, own_weights.y);
    }
    if (kClasses) {
        own_class = slots[slot].order & kClassMask;
        own_radius = class_reach(own_class);
    }
    if (kAvoids) {
        float avoided = uintBitsToFloat(slots[slot].turn);
        own_radius = avoided > 0.0 ? -avoided : (kAdaptive || kClasses ? own_radius : 0.0);
        own_class = kClasses && avoided > 0.0 ? slots[slot].order : own_class;
    }
    own_scale = scale_of(-own_radius);
}

// Places the source of an operation inside the face; returns the squared distance of the candidate from
// the start of half_edge.
float place_source() {
    if (lane.phase == kPhaseFan) {
        vec2 lit = lit_by_shadow(lane.known);
        lane.x = apex.x;
        lane.y = apex.y;
        lane.b0 = lit.x;
        lane.b1 = lit.y;
    }
    if (lane.phase == kPhaseSource) {
        vec2 at =
            position_in(lane.half_edge % 3u, edge.len, apex, own_weights.x, own_weights.y);
        lane.x = at.x;
        lane.y = at.y;
        lane.b0 = 0.0;
        lane.b1 = edge.len;
        lane.sigma = 0.0;
        lane.chain = 0u;
    }
    return lane.phase == kPhaseSource ? squared(lane.x, lane.y) : 0.0;
}

#endif
