// Read-only access to the mesh. Lengths are in units of the minimum distance, coordinates in the frame
// of a half-edge: origin at its start, x along it, its face in y >= 0.
#ifndef GEODISK_HALF_EDGE_GLSL
#define GEODISK_HALF_EDGE_GLSL

#include "job.glsl"

GEODISK_ROWS(kBindFaces, faces);

struct Edge {
    float len;
    float cosine; // of the face's angle at the origin
    float sine;
    uint origin;  // vertex and flags
    uint around;  // next half-edge of the edge, and 1 if it has the same direction
};

// Returns the lengths of a face's edges, and its cell word.
uvec4 load_lengths(uint face) { return row_at(faces, kFaceRows * job.faces + face); }
uint load_cells(uint face) { return load_lengths(face).w; }

Edge load_edge(uint face, uint corner, uvec4 lengths) {
    uvec4 row = row_at(faces, kFaceRows * face + corner);
    uint len = corner == 0u ? lengths.x : (corner == 1u ? lengths.y : lengths.z);
    return Edge(uintBitsToFloat(len), uintBitsToFloat(row.x), uintBitsToFloat(row.y), row.z, row.w);
}

uint next_corner(uint corner) { return corner == 2u ? 0u : corner + 1u; }
uint previous_corner(uint corner) { return corner == 0u ? 2u : corner - 1u; }
uint next_in_face(uint h) { return h % 3u == 2u ? h - 2u : h + 1u; }

// Returns the apex of the face in the frame of an edge; `previous` is the edge that ends where it
// starts.
vec2 apex_of(Edge edge, Edge previous) {
    precise float x = previous.len * edge.cosine;
    precise float y = previous.len * edge.sine;
    return vec2(x, y);
}

// Returns the position, in the frame of the half-edge at this corner, of the point with these weights of
// the second and third corner of the face.
vec2 position_in(uint corner, float len, vec2 apex, float weight1, float weight2) {
    precise float weight0 = 1.0 - weight1 - weight2;
    float to_end = corner == 0u ? weight1 : (corner == 1u ? weight2 : weight0);
    float to_apex = corner == 0u ? weight2 : (corner == 1u ? weight0 : weight1);
    precise float x = to_end * len + to_apex * apex.x;
    precise float y = to_apex * apex.y;
    return vec2(x, y);
}

#endif
