// Mean of 1 / g^2 over a triangle.
#pragma once

namespace geodisk {

/// Returns the mean of 1 / g^2 over a triangle in which g is linear, with these positive values at
/// the corners. Uses only + - * /, so the result is the same on every machine. Accurate to about
/// 1e-5.
double mean_inverse_square(double a, double b, double c);

} // namespace geodisk
