// The vertices a disk has reached: an open-addressed table of rows (vertex + 1, distance, half-edge
// the best ray came through, where it crossed it). An empty row starts with 0.
#ifndef GEODISK_VERTEX_TABLE_GLSL
#define GEODISK_VERTEX_TABLE_GLSL

uint table_first; // row of this slot's table
uint vertices;    // rows in use

// Row of the vertex, or the empty row where it belongs; the table's size if neither was found. With
// the table at most half full that is bad luck, which a larger table mends.
uint find_vertex(uint vertex, out uvec4 row) {
    uint mask = P.table_capacity - 1u;
    uint at = (vertex * 2654435769u) >> 7 & mask;
    // A bound that is not constant keeps compilers from unrolling what mostly ends at once.
    uint most = min(kMostProbes, P.table_capacity);
    for (uint probe = 0u; probe < most; ++probe) {
        row = pool[table_first + at];
        if (row.x == vertex + 1u || row.x == 0u) {
            return at;
        }
        at = (at + 1u) & mask;
    }
    row = uvec4(0u);
    return P.table_capacity;
}

float known_distance(uvec4 row) { return row.x == 0u ? kFar : uintBitsToFloat(row.y); }

// `at` and `found` are what find_vertex gave.
void note_vertex(uint at, uvec4 found, uint vertex, float distance, uint through, float crossing) {
    bool fresh = found.x == 0u;
    if (at == P.table_capacity || (fresh && 2u * vertices >= P.table_capacity)) {
        overflow |= kOverflowVertices;
        return;
    }
    vertices += fresh ? 1u : 0u;
    pool[table_first + at] =
        uvec4(vertex + 1u, floatBitsToUint(distance), through, floatBitsToUint(crossing));
}

#endif
