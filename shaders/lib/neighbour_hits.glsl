// Hits, and which of them are neighbours. Several hits may be of one neighbour.
#ifndef GEODISK_NEIGHBOUR_HITS_GLSL
#define GEODISK_NEIGHBOUR_HITS_GLSL

#include "neighbour.glsl"
#include "scaled.glsl"

GEODISK_BUFFER(kBindWeights, readonly, uvec4, recorded);
GEODISK_BUFFER(kBindNames, readonly, uint, names);
GEODISK_BUFFER(kBindLimits, readonly, uint, limits);
GEODISK_BUFFER(kBindRows, coherent, uint, rows);

// Numbers of a hit's target: from `first` up to `end` in the table of names, or one alone.
struct Hit {
    uint source; // in the part at hand
    uint target;
    uint distance;
    uint first;
    uint end;
};

Hit hit_at(uint index) {
    uvec4 row = recorded[recorded[0].z + index];
    Hit hit = Hit(row.x, row.y, in_mesh_units(row.z), 0u, 1u);
    if (push.has_names != 0u) {
        hit.first = names[hit.target];
        hit.end = min(names[hit.target + 1u], hit.first + kMaxNames);
    }
    return hit;
}

uint number_of(Hit hit, uint at) { return push.has_names != 0u ? names[at] : hit.target; }

// Returns how many entries the hit makes.
uint entries_of(Hit hit) {
    uint source = push.first_source + hit.source;
    bool is_own = push.skips_own != 0u && number_of(hit, hit.first) == source;
    return hit.distance > limits[source] || is_own ? 0u : hit.end - hit.first;
}

#endif
