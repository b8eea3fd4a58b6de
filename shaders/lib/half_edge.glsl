// Read-only access to the mesh: half-edges in their own frames.
#ifndef GEODISK_HALF_EDGE_GLSL
#define GEODISK_HALF_EDGE_GLSL

GEODISK_BUFFER(kBindHalfEdges, readonly, uvec4, half_edges);

struct Edge {
    float len;
    float apex_x;
    float apex_y;
    uint origin;
    bool border;
};

struct Turn {
    float cosine;
    float sine;
    uint around;
    uint fan_angles;
};

Edge load_edge(uint h) {
    uvec4 row = half_edges[2u * h];
    return Edge(uintBitsToFloat(row.x), uintBitsToFloat(row.y), uintBitsToFloat(row.z),
                row.w & ~kBorder, (row.w & kBorder) != 0u);
}

Turn load_turn(uint h) {
    uvec4 row = half_edges[2u * h + 1u];
    return Turn(uintBitsToFloat(row.x), uintBitsToFloat(row.y), row.z, row.w);
}

uint next_in_face(uint h) { return h % 3u == 2u ? h - 2u : h + 1u; }
uint previous_in_face(uint h) { return h % 3u == 0u ? h + 2u : h - 1u; }

// Position, in the frame of half-edge h, of the point with these weights of the second and third
// corner of its face.
vec2 position_in(uint h, Edge edge, float weight1, float weight2) {
    precise float weight0 = 1.0 - weight1 - weight2;
    uint k = h % 3u;
    float end = k == 0u ? weight1 : (k == 1u ? weight2 : weight0);
    float apex = k == 0u ? weight2 : (k == 1u ? weight0 : weight1);
    precise float x = end * edge.len + apex * edge.apex_x;
    precise float y = apex * edge.apex_y;
    return vec2(x, y);
}

#endif
