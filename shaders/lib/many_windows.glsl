// When windows must be trimmed.
#ifndef GEODISK_MANY_WINDOWS_GLSL
#define GEODISK_MANY_WINDOWS_GLSL

#include "rounding.glsl"

// Returns true if a disk has too many windows and events: more than `least`, and than suits the vertices
// that it has reached.
bool makes_many(uint least, uint vertices, uint longest_chain, uint pushed) {
    uint counted = min(vertices, kUntrimmedVertices);
    uint across = uint(root(float(counted)));
    bool is_strip = longest_chain > vertices / kStripChain;
    uint most = longest_chain > kLongStrip ? 0u : kStripRoot;
    uint each = kUntrimmedEach + kUntrimmedPerRoot * (is_strip ? min(across, most) : across);
    return pushed > least + counted * each;
}

#endif
