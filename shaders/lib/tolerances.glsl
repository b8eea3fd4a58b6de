// Every epsilon of the shaders, in units of the minimum distance where it is a length.
#ifndef GEODISK_TOLERANCES_GLSL
#define GEODISK_TOLERANCES_GLSL

// Part of an edge below which a position counts as the edge's end; keeps quotients normal.
const float kSmallestRatio = 9.094947e-13;  // 2^-40
// Coordinates below it count as zero.
const float kSmallestOffset = 9.094947e-13; // 2^-40
// Squares below it count as zero.
const float kSmallestSquare = 7.888609e-31; // 2^-100
// Stands for a distance not known; its square is still finite.
const float kFar = 1073741824.0;            // 2^30
// Sources closer than this to a vertex light its whole fan: unfolding around so near a vertex would
// lose the direction.
const float kNearVertex = 0.0009765625;     // 2^-10
// A window is trimmed where another one is not farther by more than this, or this part of
// JobRec::base_error: positions on longer edges round to more.
const float kTrimError = 1.1920929e-7;      // 2^-23
const float kTrimPart = 0.0625;             // 2^-4
// Bound on the error that a crossing adds to a distance.
const float kCrossingError = 2.3841858e-7;  // 2^-22
// Part of the slack by which the place where a ray crosses an edge may be off.
const float kCrossingPart = 0.0625;         // 2^-4
// Part of an edge within which a source on its line counts as its end.
const float kEdgeGrain = 4.7683716e-7;      // 2^-21
// Rounding of positions against cell borders, relative to the face's extent.
const float kCellPadding = 9.5367432e-7;    // 2^-20
// Cosines of angles closer than this count as equal.
const float kSameAngle = 0.015625;          // 2^-6

#endif
