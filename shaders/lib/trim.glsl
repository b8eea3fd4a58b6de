// Windows trimmed against each other (Mitchell, Mount and Papadimitriou 1987), in disks that make very
// many: around needles and thin tubes, and at edges of many faces. Of the windows that came to an edge,
// from whichever face, the widest are kept and the last that was narrower, in a table of constant size
// where other edges may take their place, which only lets windows live. kernels_ref/kernels/trim.hpp is
// the same.
//
// Whether a disk trims hangs on nothing but the disk, and never on the plan of the run, so that what it
// computes does not either. Rows of a window, in the frame of the edge from its lower vertex on: (lower
// vertex, higher vertex, x, |y|), (b0, b1, sigma, generation of the disk).
#ifndef GEODISK_TRIM_GLSL
#define GEODISK_TRIM_GLSL

bool window_taken; // in this trip

// Edges that share rows do so in whatever place of a job their mesh has its vertices: the sum is linear.
uint kept_row(uvec2 ends) {
    uint mixed = ends.x * 2654435769u + (ends.y - ends.x) * 625341585u;
    return first_kept + kKeptRows * kKeptPerEdge * (mixed & (kKeptEdges - 1u));
}

// Whether the kept window is at most kTrimError farther from here, on the edge, than the one in flight,
// whose source is at sx and lane.y off the edge.
bool is_as_near(vec2 kept_source, float kept_sigma, float sx, float at) {
    precise float dx = at - sx;
    precise float distance = lane.sigma + root(squared(dx, lane.y));
    precise float rest = (distance - kept_sigma) + kTrimError;
    precise float rest_square = rest * rest;
    precise float kept_dx = at - kept_source.x;
    return rest >= 0.0 && squared(kept_dx, kept_source.y) <= rest_square;
}

// Whether it is so all along what the window in flight lights within reach. The difference of the two is
// largest at an end, or where both sources lie on one line with the point.
bool dominates(vec2 kept_source, float kept_sigma, vec2 kept_lit, float sx, vec2 lit) {
    precise float way = P.limit - lane.sigma;
    precise float first = sx - way;
    precise float last = sx + way;
    float low = max(lit.x, first);
    float high = min(lit.y, last);
    precise float kept_low = kept_lit.x - kTrimError;
    precise float kept_high = kept_lit.y + kTrimError;
    precise float turn = sx * kept_source.y - kept_source.x * lane.y;
    precise float rise = kept_source.y - lane.y;
    float over = rise < 0.0 ? -turn : turn;
    float under = abs(rise);
    precise float width = high - low;
    precise float past_low = over - low * under;
    precise float across = width * under;
    precise float on_line = low + width * (across > kSmallestSquare ? ratio(past_low, across) : 0.0);
    return kept_low <= low && kept_high >= high && is_as_near(kept_source, kept_sigma, sx, low) &&
           is_as_near(kept_source, kept_sigma, sx, high) &&
           is_as_near(kept_source, kept_sigma, sx, on_line);
}

// Whether the disk is to begin again, trimming.
bool makes_many() {
    uint vertices = min(lane.vertices, kUntrimmedVertices);
    uint each = kUntrimmedEach + (vertices >> kUntrimmedShift);
    return !trims() && lane.pushed > kUntrimmedWindows + vertices * each;
}

// A position on the edge, from its lower vertex on, if that is its end.
float from_lower(bool turned, float at) {
    precise float from_end = edge.len - at;
    return turned ? from_end : at;
}

vec2 lit_from_lower(bool turned, vec2 lit) {
    vec2 ends = turned ? lit.yx : lit;
    return vec2(from_lower(turned, ends.x), from_lower(turned, ends.y));
}

// Whether the disk goes on without end though it trims: at edges of many faces windows branch, and those
// kept hardly cover what comes.
bool is_endless() {
    uint vertices = min(lane.vertices, kUntrimmedVertices);
    return trims() && lane.pushed - lane.trims > kMostWindows + vertices * kMostPerVertex;
}

// Whether the window just taken is to go, where the disk trims; else it may be kept from now on.
bool trimmed() {
    if (!trims() || !window_taken) {
        return false;
    }
    uint start = edge.origin & kVertexMask;
    uint end = right.origin & kVertexMask;
    bool turned = start > end;
    uvec2 ends = turned ? uvec2(end, start) : uvec2(start, end);
    float sx = from_lower(turned, entry_x());
    vec2 lit = lit_from_lower(turned, entry_interval());
    precise float width = lit.y - lit.x;
    uint first = kept_row(ends);
    float least = kFar;
    uint gives_way = 0u; // the narrowest, or one of another edge
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
