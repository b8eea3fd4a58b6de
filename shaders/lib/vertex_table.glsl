// The vertices a disk has reached: an open-addressed table of rows (vertex + 1, distance, half-edge
// the best ray came through, where it crossed it). An empty row starts with 0.
#ifndef GEODISK_VERTEX_TABLE_GLSL
#define GEODISK_VERTEX_TABLE_GLSL

uint table_first; // row of this slot's table
uint vertices;    // rows in use

// Longest run of rows looked at; with the table at most three quarters full it is reached only by
// bad luck, which a larger table mends.
const uint kMostProbes = 64u;

// Row of the vertex, or the empty row where it belongs; the table's size if neither was found.
uint find_vertex(uint vertex, out uvec4 row) {
    uint mask = push.table_capacity - 1u;
    uint at = (vertex * 2654435769u) >> 7 & mask;
    for (uint probe = 0u; probe < kMostProbes; ++probe) {
        ++trips;
        row = pool[table_first + at];
        if (row.x == vertex + 1u || row.x == 0u) {
            return at;
        }
        at = (at + 1u) & mask;
    }
    row = uvec4(0u);
    return push.table_capacity;
}

float known_distance(uvec4 row) { return row.x == 0u ? kFar : uintBitsToFloat(row.y); }

void note_vertex(uint vertex, float distance, uint through, float crossing) {
    uvec4 row;
    uint at = find_vertex(vertex, row);
    bool fresh = row.x == 0u;
    if (at == push.table_capacity || (fresh && 4u * vertices >= 3u * push.table_capacity)) {
        overflow |= kOverflowVertices;
        return;
    }
    vertices += fresh ? 1u : 0u;
    pool[table_first + at] =
        uvec4(vertex + 1u, floatBitsToUint(distance), through, floatBitsToUint(crossing));
}

#endif
