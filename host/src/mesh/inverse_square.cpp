#include "mesh/inverse_square.hpp"

#include <utility>

namespace geodisk {
namespace {

double inverse_square(double g) {
    return 1 / (g * g);
}

/// Applies Radon's seven-point rule, exact for polynomials of degree 5 (1948).
double radon_mean(double a, double b, double c) {
    constexpr double kNearCorner = 0.79742698535308732, kAside = 0.10128650732345634;
    constexpr double kNearSide = 0.059715871789769820, kBetween = 0.47014206410511509;
    constexpr double kCornerWeight = 0.12593918054482715, kSideWeight = 0.13239415278850618;
    const double sum = a + b + c;
    const auto along = [sum](double x, double own, double others) {
        return inverse_square(own * x + others * (sum - x));
    };
    return 0.225 * inverse_square(sum / 3) +
           kCornerWeight * (along(a, kNearCorner, kAside) + along(b, kNearCorner, kAside) +
                            along(c, kNearCorner, kAside)) +
           kSideWeight * (along(a, kNearSide, kBetween) + along(b, kNearSide, kBetween) +
                          along(c, kNearSide, kBetween));
}

} // namespace

double mean_inverse_square(double a, double b, double c) {
    if (a > b) {
        std::swap(a, b);
    }
    if (b > c) {
        std::swap(b, c);
    }
    if (a > b) {
        std::swap(a, b);
    }
    constexpr double kGentle = 1.5;
    if (c <= kGentle * a) {
        return radon_mean(a, b, c);
    }
    // Split the edge along which g changes most.
    const double middle = (a + c) / 2;
    return (mean_inverse_square(a, b, middle) + mean_inverse_square(middle, b, c)) / 2;
}

} // namespace geodisk
