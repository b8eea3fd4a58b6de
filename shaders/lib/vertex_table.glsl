// Vertices that a disk has reached: an open-addressed table of rows (vertex, distance, half-edge of the
// best ray, where it crossed it). The two top bits of the first two words identify the disk; rows of
// another disk count as empty.
#ifndef GEODISK_VERTEX_TABLE_GLSL
#define GEODISK_VERTEX_TABLE_GLSL

uint vertex_row(uint at) { return own_row(first_vertex + at); }

uint vertex_tag() { return lane.generation << kTagShift; }
uint distance_tag() { return (lane.generation << (kTagShift - 2u)) & kTagMask; }

struct VertexRow {
    uint at;        // row, or where it belongs; size of the table if neither was found
    bool found;
    float distance; // kFar if not found
    uint through;
    float crossing;
};

// The table is at most half full, so not finding a place is rare; a larger table then helps.
VertexRow find_vertex(uint vertex) {
    uint mask = push.table_capacity - 1u;
    uint at = (vertex * 2654435769u) >> 7 & mask;
    uint place = push.table_capacity;
    uvec4 row = uvec4(0u);
    bool found = false;
    // A bound that is not constant prevents unrolling a loop that mostly ends at once.
    uint most = min(kMaxProbes, push.table_capacity);
    for (uint probe = 0u; probe < most; ++probe) {
        row = own_row_at(pool, vertex_row(at));
        bool empty = (row.x & kTagMask) != vertex_tag() || (row.y & kTagMask) != distance_tag();
        found = !empty && (row.x & kVertexMask) == vertex;
        if (empty || found) {
            place = at;
            break;
        }
        at = (at + 1u) & mask;
    }
    return VertexRow(place, found, found ? uintBitsToFloat(row.y & ~kTagMask) : kFar, row.z,
                     uintBitsToFloat(row.w));
}

// Stores a vertex; `row` is from find_vertex.
void note_vertex(VertexRow row, uint vertex, float distance, uint through, float crossing) {
    if (row.at == push.table_capacity || (!row.found && 2u * lane.vertices >= push.table_capacity)) {
        overflow |= kOverflowVertices;
        return;
    }
    lane.vertices += row.found ? 0u : 1u;
    pool[vertex_row(row.at)] =
        uvec4(vertex | vertex_tag(), floatBitsToUint(distance) | distance_tag(), through,
              floatBitsToUint(crossing));
}

#endif
