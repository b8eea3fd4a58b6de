// Places of the candidates of faces. A constant of the kernel: lavapipe compiles a kernel again
// whenever the constants of a job change that it branches on.
#ifndef GEODISK_MANY_ROWS_GLSL
#define GEODISK_MANY_ROWS_GLSL

// Faces have several rows of cells. Otherwise each has one cell, and the table of cells is that of starts.
layout(constant_id = kSpecManyRows) const bool kManyRows = false;

#endif
