// Trimming of windows against each other (Mitchell, Mount and Papadimitriou 1987), in disks with very
// many: around needles and thin tubes, and at edges of many faces. Of the windows that came to an edge,
// from any face, the widest and the last narrower one are kept in a table of constant size. Other edges
// may overwrite them, which only keeps windows alive. kernels_ref/kernels/trim.hpp is the same.
//
// The choice to trim depends only on the disk, never on the plan of the run; so do its results.
// Rows of a window, in the frame of the edge from its lower vertex: (lower vertex, higher vertex,
// x, |y|), (b0, b1, sigma, generation of the disk).
#ifndef GEODISK_TRIM_GLSL
#define GEODISK_TRIM_GLSL

#include "job.glsl"
#include "many_windows.glsl"

const float kNearSource = 1024.0; // inverse of the distance below which a source is near

bool window_taken; // in this trip

// Returns the row of an edge. The sum is linear, so edges share rows independently of the numbering of a
// mesh within a job.
uint kept_row(uvec2 ends) {
    uint mixed = ends.x * 2654435769u + (ends.y - ends.x) * 625341585u;
    return first_kept + kKeptRows * kKeptPerEdge * (mixed & (kKeptEdges - 1u));
}

// Returns true if the kept window is hardly farther, by trim_error(), at this position of the edge, than the
// one in flight, whose source is at sx along and lane.y off the edge. Where the kept one does not light the
// position, a path goes on from its end along the edge. That path bends, so it must be shorter by the margin.
// A position beside the end by rounding counts as lit. If the source in flight is near the position, so little
// of the edge turns its rays far: less counts then.
bool is_as_near(vec2 kept_source, float kept_sigma, vec2 kept_lit, float sx, float at) {
    precise float dx = at - sx;
    precise float way = root(squared(dx, lane.y));
    precise float nearness = way * kNearSource;
    precise float beside = trim_error() * min(nearness, 1.0);
    precise float kept_low = kept_lit.x - beside;
    precise float kept_high = kept_lit.y + beside;
    float lit_at = min(max(at, kept_low), kept_high);
    precise float along_edge = abs(at - lit_at) + margin;
    precise float distance = lane.sigma + way;
    precise float rest = (distance - kept_sigma) + (lit_at == at ? trim_error() : -along_edge);
    precise float rest_square = rest * rest;
    precise float kept_dx = lit_at - kept_source.x;
    return rest >= 0.0 && squared(kept_dx, kept_source.y) <= rest_square;
}

// Returns true if this holds everywhere that the window in flight lights within reach. The difference of
// the two is largest at an end, or where both sources are collinear with the point. Along the edge it grows
// away from what the kept one lights.
bool dominates(vec2 kept_source, float kept_sigma, vec2 kept_lit, float sx, vec2 lit) {
    precise float way = path_limit() - lane.sigma;
    precise float first = sx - way;
    precise float last = sx + way;
    float low = max(lit.x, first);
    float high = min(lit.y, last);
    precise float kept_low = kept_lit.x - trim_error();
    precise float kept_high = kept_lit.y + trim_error();
    precise float turn = sx * kept_source.y - kept_source.x * lane.y;
    precise float rise = kept_source.y - lane.y;
    float over = rise < 0.0 ? -turn : turn;
    float under = abs(rise);
    float first_both = max(low, kept_low);
    float last_both = min(high, kept_high);
    precise float width = last_both - first_both;
    precise float past_first = over - first_both * under;
    precise float across = width * under;
    precise float on_line =
        first_both + width * (across > kSmallestSquare ? ratio(past_first, across) : 0.0);
    float between = first_both < last_both ? on_line : low;
    return is_as_near(kept_source, kept_sigma, kept_lit, sx, low) &&
           is_as_near(kept_source, kept_sigma, kept_lit, sx, high) &&
           is_as_near(kept_source, kept_sigma, kept_lit, sx, between);
}

// Converts a position on the edge to one from its lower vertex, if that is its end.
float from_lower(bool turned, float at) {
    precise float from_end = edge.len - at;
    return turned ? from_end : at;
}

vec2 lit_from_lower(bool turned, vec2 lit) {
    vec2 ends = turned ? lit.yx : lit;
    return vec2(from_lower(turned, ends.x), from_lower(turned, ends.y));
}

// Returns true if the disk does not end although it trims: at edges of many faces windows branch, and
// the kept ones hardly cover new ones.
bool is_endless() {
    uint vertices = min(lane.vertices, kUntrimmedVertices);
    return trims() && lane.pushed - lane.trims > kMaxWindows + vertices * kMaxPerVertex;
}

// Returns true if the window just taken is dropped by trimming; otherwise it may be kept from now on.
bool trimmed() {
    if (!trims() || !window_taken) {
        return false;
    }
    set_margin();
    uint start = edge.origin & kVertexMask;
    uint end = right.origin & kVertexMask;
    bool turned = start > end;
    uvec2 ends = turned ? uvec2(end, start) : uvec2(start, end);
    float sx = from_lower(turned, entry_x());
    vec2 lit = lit_from_lower(turned, entry_interval());
    precise float width = lit.y - lit.x;
    uint first = kept_row(ends);
    float least = kFar;
    uint gives_way = 0u; // row to replace: the narrowest, or one of another edge
    for (uint i = 0u; i < kKeptPerEdge; ++i) {
        uint at = first + kKeptRows * i;
        uvec4 row0 = own_row_at(pool, own_row(at));
        uvec4 row1 = own_row_at(pool, own_row(at + 1u));
        bool of_edge = row0.xy == ends && row1.w == lane.generation;
        vec2 kept_lit = uintBitsToFloat(row1.xy);
        if (of_edge &&
            dominates(uintBitsToFloat(row0.zw), uintBitsToFloat(row1.z), kept_lit, sx, lit)) {
            return true;
        }
        precise float difference = kept_lit.y - kept_lit.x;
        float kept_width = of_edge ? difference : -1.0;
        bool gives = i + 1u < kKeptPerEdge && kept_width < least;
        least = gives ? kept_width : least;
        gives_way = gives ? i : gives_way;
    }
    uint at = first + kKeptRows * (width < least ? kKeptPerEdge - 1u : gives_way);
    pool[own_row(at)] = uvec4(ends, floatBitsToUint(sx), floatBitsToUint(lane.y));
    pool[own_row(at + 1u)] = uvec4(floatBitsToUint(lit.x), floatBitsToUint(lit.y),
                                   floatBitsToUint(lane.sigma), lane.generation);
    return false;
}

#endif
