// Dart order. Within a stage, candidates are ordered by priority; for equal priorities, by face and
// weights.
#ifndef GEODISK_DART_ORDER_GLSL
#define GEODISK_DART_ORDER_GLSL

// Returns true if one comes before another, given the four words of their samples.
bool is_before(uvec4 a, uvec4 b) {
    return a.x != b.x   ? a.x < b.x
           : a.y != b.y ? a.y < b.y
           : a.z != b.z ? a.z < b.z
                        : a.w < b.w;
}

#endif
