// Dart order. Within a stage, candidates are ordered by priority; for equal priorities, by face and
// weights. If faces have keys, by weights, so that the numbers of faces do not matter.
#ifndef GEODISK_DART_ORDER_GLSL
#define GEODISK_DART_ORDER_GLSL

#include "job.glsl"

// Returns true if one comes before another, given the four words of their samples.
bool is_before(uvec4 a, uvec4 b) {
    bool by_weights = job.has_keys != 0u;
    uvec3 first = by_weights ? a.zwy : a.yzw;
    uvec3 second = by_weights ? b.zwy : b.yzw;
    return a.x != b.x            ? a.x < b.x
           : first.x != second.x ? first.x < second.x
           : first.y != second.y ? first.y < second.y
                                 : first.z < second.z;
}

#endif
