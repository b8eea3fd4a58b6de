// The order in which candidates are thrown. Within a stage it is that of their priorities; where these
// are equal, of faces and weights.
#ifndef GEODISK_DART_ORDER_GLSL
#define GEODISK_DART_ORDER_GLSL

// Whether one comes before another; of each the four words of its sample.
bool is_before(uvec4 a, uvec4 b) {
    return a.x != b.x   ? a.x < b.x
           : a.y != b.y ? a.y < b.y
           : a.z != b.z ? a.z < b.z
                        : a.w < b.w;
}

#endif
