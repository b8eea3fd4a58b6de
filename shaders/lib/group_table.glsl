// Vertices that a disk in waves has reached: an open-addressed table that the invocations of a work group
// fill together. Rows of a vertex:
//   (1 + vertex, nearness, nearness that an event was made for, -)
//   (highest way, lowest way, lowest crossing, longest chain and its blur)  of all shortest paths to it
// Nearness is the complement of the distance's word: larger is nearer, and 0 is not reached. What is lowest
// is a complement as well, and a crossing an ordered word, so that 0 is less than all.
//
// A way is the corner that a path came in through, plus 1, doubled, and 1 more if it came along an edge; 0
// for a source so near that the whole fan is lit.
#ifndef GEODISK_GROUP_TABLE_GLSL
#define GEODISK_GROUP_TABLE_GLSL

const uint kWholeWay = 0u;

uint way_of(uint corner, bool along_edge) { return (corner + 1u) << 1 | (along_edge ? 1u : 0u); }
uint corner_of(uint way) { return way == kWholeWay ? kWholeFan : (way >> 1) - 1u; }

uint nearness_of(float distance) { return ~floatBitsToUint(distance); }
float distance_of(uint nearness) { return nearness == 0u ? kFar : uintBitsToFloat(~nearness); }

// Converts to a word that compares like the number, and back.
uint ordered_word(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float from_ordered(uint word) {
    return uintBitsToFloat((word & 0x80000000u) != 0u ? word & 0x7fffffffu : ~word);
}

uint first_probe(uint vertex) { return (vertex * 2654435769u) >> 7 & (push.table_capacity - 1u); }

// Returns the number of a vertex in the table, and adds it if need be; kNoVertex if there is no room. Keys
// never change, so an atomic is needed only where there seems to be none.
uint find_or_add(uint vertex) {
    uint at = first_probe(vertex);
    uint found = kNoVertex;
    uint most = min(kMaxProbes, push.table_capacity);
    for (uint probe = 0u; probe < most; ++probe) {
        uint key = own_row_at(pool, table_row(at)).x;
        if (key == 0u) {
            key = atomicCompSwap(pool[table_row(at)].x, 0u, vertex + 1u);
            if (key == 0u) {
                uint number = atomicAdd(group.vertices, 1u);
                if (2u * number >= push.table_capacity) {
                    break;
                }
                write_word(vertex_word(number), at);
                key = vertex + 1u;
            }
        }
        if (key == vertex + 1u) {
            found = at;
            break;
        }
        at = (at + 1u) & (push.table_capacity - 1u);
    }
    overflow |= found == kNoVertex ? kOverflowVertices : 0u;
    return found;
}

// Returns the number of a vertex in the table; kNoVertex if it is not there.
uint find(uint vertex) {
    uint at = first_probe(vertex);
    uint found = kNoVertex;
    uint most = min(kMaxProbes, push.table_capacity);
    for (uint probe = 0u; probe < most; ++probe) {
        uint key = own_row_at(pool, table_row(at)).x;
        found = key == vertex + 1u ? at : kNoVertex;
        if (key == 0u || key == vertex + 1u) {
            break;
        }
        at = (at + 1u) & (push.table_capacity - 1u);
    }
    return found;
}

// Proposes a path of the window to a vertex.
void propose(uint window, uint origin, float distance, float crossing) {
    if (!(distance < reach())) {
        return;
    }
    uint at = find_or_add(origin & kVertexMask);
    if (at == kNoVertex) {
        return;
    }
    uint nearness = nearness_of(distance);
    uint before = atomicMax(pool[table_row(at)].y, nearness);
    if (before != 0u && before < nearness) {
        pool[table_row(at) + 1u] = uvec4(0u); // All that improve it write the same.
    }
    if (before <= nearness) {
        push_proposal(uvec4(window, at | ((origin & kOriginBends) != 0u ? kBendsThere : 0u),
                            floatBitsToUint(distance), floatBitsToUint(crossing)));
    }
}

// Keeps a proposed path to a vertex, if none is shorter. Makes an event if the fan is lit.
void settle(uint vertex, uint distance, uint way, float crossing, uint chain, uint blur) {
    uint at = vertex & ~kBendsThere;
    uint row = table_row(at);
    if (own_row_at(pool, row).y != ~distance) {
        return;
    }
    atomicMax(pool[row + 1u].x, way);
    atomicMax(pool[row + 1u].y, ~way);
    atomicMax(pool[row + 1u].z, ~ordered_word(crossing));
    atomicMax(pool[row + 1u].w, chain << kBlurBits | blur);
    bool is_lit = way == kWholeWay || (vertex & kBendsThere) != 0u;
    uint lit_at = is_lit ? atomicExchange(pool[row].z, ~distance) : ~distance;
    if (lit_at != ~distance) {
        uint event = atomicAdd(group.events, 1u);
        if (event >= push.window_capacity) {
            overflow |= kOverflowWindows;
            return;
        }
        pool[event_row(group.turn, event)] = uvec4(at, ~distance, 0u, kWholeRange);
        ++own_pushed;
        own_lit_again += lit_at != 0u ? 1u : 0u;
        own_longest = max(own_longest, chain);
    }
}

#endif
