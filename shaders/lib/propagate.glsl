// Spreads the operation in flight in a lane that works alone, see windows.glsl. kernels_ref/kernels/
// detect.hpp is the same in plain C++; read that first.
//
// The event of a vertex is one row: (vertex, sigma, chain and arrival of its path, corner that it came in
// through).
#ifndef GEODISK_PROPAGATE_GLSL
#define GEODISK_PROPAGATE_GLSL

#include "shadow.glsl"
#include "windows.glsl"

// Returns how the straight path in flight arrives: from the candidate at the start of edge, or from a window
// at the apex.
uint arrival_of_path(Meeting m, float distance) {
    bool inside = lane.mode == kModeInside;
    float sx = entry_x();
    precise float aside = lane.y + apex.y;
    precise float along = apex.x * (apex.x - sx) + apex.y * aside;
    precise float across = apex.x * lane.y + apex.y * sx;
    uint blur = blur_of(error_of(lane.chain + 1u), inside ? distance : m.way);
    return arrival_from(inside ? lane.x : along, inside ? lane.y : across, blur);
}

layout(constant_id = kSpecBounded) const bool kBounded = false;

// Returns the distance of a vertex from which on another settled sample is nearer, and so to all behind it:
// kFar if none is known to be. Paths that long end, with room for rounding.
float bound_of(uint vertex) {
    if (!kBounded) {
        return kFar;
    }
    bool is_bounded = (job.path_rules & kRuleBounded) != 0u && own_place == kNoPlace && !keeps_out();
    uint row = is_bounded ? after_fans() + (vertex >> 2) : 0u;
    float bound = uintBitsToFloat(row_at(fans, row)[vertex & 3u]);
    precise float end = bound + 2.0 * margin;
    return is_bounded ? end : kFar;
}

// Ends the paths in flight at vertices: those of a window at the apex, others at the ends of the edge.
// Vertices where shortest paths may bend become events. Returns the known distances of start, end and
// apex; `source_square` is the squared distance of the candidate from the start.
vec3 reach_vertices(inout Meeting m, float source_square) {
    bool inside = lane.mode == kModeInside;
    bool from_vertex = lane.phase == kPhaseFan;
    vec3 distances = vec3(known_ends(), kFar);
    precise float start_distance = lane.sigma + (from_vertex ? left.len : root(source_square));
    precise float end_distance = lane.sigma + right.len;
    uint arrival = arrival_of_path(m, start_distance);
    for (uint i = inside ? 0u : 2u; i < (inside ? 2u : 3u); ++i) {
        uint origin = i == 0u ? edge.origin : (i == 1u ? right.origin : left.origin);
        uint vertex = origin & kVertexMask;
        float distance = i == 0u ? start_distance
                         : i == 1u ? (from_vertex ? end_distance : kFar)
                                   : (m.sees_apex ? m.distance : kFar);
        VertexRow row = find_vertex(vertex);
        float best = min(row.distance, bound_of(vertex));
        if (i == 2u) {
            split_once(m, row.found && row.through == lane.half_edge, row.distance, row.crossing);
        }
        if (distance < best && distance < reach()) {
            best = distance;
            note_vertex(row, vertex, distance, inside ? kNoHalfEdge : lane.half_edge,
                        inside ? 0.0 : m.crossing);
#ifdef GEODISK_REACH
            note_reached(vertex, distance);
#endif
            bool whole_fan = lane.phase == kPhaseSource && distance <= kNearVertex;
            if (whole_fan || (origin & kOriginBends) != 0u) {
                uint corner = i == 0u   ? lane.half_edge
                              : i == 1u ? next_in_face(lane.half_edge)
                                        : next_in_face(next_in_face(lane.half_edge));
                lane.longest_chain = max(lane.longest_chain, lane.chain + 1u);
                uint arrived = !from_vertex ? arrival : (i == 0u ? kArrivedAlongPrevious : 0u);
                push_event(uvec4(vertex, floatBitsToUint(distance),
                                 (lane.chain + 1u) << kChainShift | arrived,
                                 whole_fan ? kWholeFan : corner));
            }
        }
        distances.x = i == 0u ? best : distances.x;
        distances.y = i == 1u ? best : distances.y;
        distances.z = i == 2u ? best : distances.z;
    }
    return distances;
}

// Applies the operation in flight to vertices and edges. The nearer child of a window is pushed last, or
// held, so that it is next.
void spread(float source_square) {
    bool inside = lane.mode == kModeInside;
    float sx = entry_x();
    vec2 lit = entry_interval();
    Meeting m = meet_apex(sx, lit);
    vec3 distances = reach_vertices(m, source_square);
    uint remembered = remember();
    Window first = kNoChild;
    Window second = kNoChild;
    for (uint i = 0u; i < (inside ? 1u : 2u); ++i) {
        first = second;
        second = kNoChild;
        if (inside || (i == 0u ? m.to_left : m.to_right)) {
            second = leave(i == 0u, m, sx, lit, distances);
        }
    }
    bool has_first = first.distance >= 0.0;
    bool has_second = second.distance >= 0.0;
    if (!has_first && !has_second) {
        return;
    }
    lane.longest_chain = max(lane.longest_chain, lane.chain + 1u);
    if (!kTrims && lane.chain + 1u >= kFirstRemembered) {
        overflow |= kOverflowTrims;
    }
    bool has_both = has_first && has_second;
    Window nearer = second;
    Window other = first;
    if (has_both ? first.distance < second.distance : has_first) {
        nearer = first;
        other = second;
    }
    bool holds = kHolds && lane.phase == kPhaseCross && !enters_more();
    if (holds) {
        hold_window(nearer.row0, nearer.row1);
    }
    uint pushed = (has_both ? 1u : 0u) + (holds ? 0u : 1u);
    for (uint i = 0u; i < pushed; ++i) {
        Window next = nearer;
        if (i == 0u && has_both) {
            next = other;
        }
        push_window(next.distance, next.row0, next.row1, remembered);
    }
}

#endif
