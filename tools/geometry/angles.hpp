// Sines, cosines and angles that are the same to the bit on every system. Those of C libraries
// differ in the last bits, and with them surfaces and their samples would.
#pragma once

namespace geodisk::tools {

/// Sine and cosine of an angle of up to about 2^20, within some units of the last place.
double sine(double angle);
double cosine(double angle);

/// The angle between a vector and its first axis, from 0 to pi; 0 of no vector. y is not negative.
double angle_of(double y, double x);

} // namespace geodisk::tools
