// Number of coordinates of points.
#ifndef GEODISK_DIMENSION_GLSL
#define GEODISK_DIMENSION_GLSL

layout(constant_id = kSpecDimension) const uint kDimension = 3u;

#endif
