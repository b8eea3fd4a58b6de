// The mean of 1 / g^2 over a triangle.
#pragma once

namespace geodisk {

/// The mean of 1 / g^2 over a triangle in which g is linear and has these positive values at the
/// corners. By + - * / alone, so it is the same on every machine; to about 1e-5.
double mean_inverse_square(double a, double b, double c);

} // namespace geodisk
