#include "geodisk/box_text.hpp"

#include <algorithm>
#include <cmath>

#include "common/number_text.hpp"

namespace geodisk::tools {

std::string sides_text(const BoxParams& box, std::string (*text)(double side)) {
    std::string sides;
    for (const double side : box.extents) {
        sides += (sides.empty() ? "" : " x ") + text(side);
    }
    return sides;
}

std::string box_text(const BoxParams& box) {
    return sides_text(box, [](double side) { return rounded(side, 6); }) + ", " + kind_text(box);
}

const char* kind_text(const BoxParams& box) {
    return box.is_periodic ? "periodic" : "open";
}

double diagonal_of(const BoxParams& box) {
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double sum = 0;
    for (const double side : box.extents) {
        sum += (side / longest) * (side / longest);
    }
    return longest * std::sqrt(sum);
}

} // namespace geodisk::tools
