// When windows must be trimmed.
#ifndef GEODISK_MANY_WINDOWS_GLSL
#define GEODISK_MANY_WINDOWS_GLSL

// Returns true if a disk has too many windows and events: more than `least`, and than suits the vertices
// that it has reached.
bool makes_many(uint least, uint vertices, uint pushed) {
    uint counted = min(vertices, kUntrimmedVertices);
    uint each = kUntrimmedEach + (counted >> kUntrimmedShift);
    return pushed > least + counted * each;
}

#endif
