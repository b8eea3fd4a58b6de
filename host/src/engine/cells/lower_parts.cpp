#include "engine/cells/lower_parts.hpp"

#include <cmath>
#include <utility>

namespace geodisk {

void LowerParts::clip(const CornerValues& function) {
    const auto value_at = [&](const Vertex& vertex) {
        return vertex.weights[0] * function[0] + vertex.weights[1] * function[1] +
               vertex.weights[2] * function[2];
    };
    clipped_.clear();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const Vertex& from = polygon_[i];
        const Vertex& to = polygon_[(i + 1) % polygon_.size()];
        const double start = value_at(from), end = value_at(to);
        if (start >= 0) {
            clipped_.push_back(from);
        }
        if ((start < 0) != (end < 0)) {
            const double part = start / (start - end);
            Vertex crossing{};
            for (std::size_t k = 0; k < 3; ++k) {
                crossing.weights[k] = from.weights[k] + part * (to.weights[k] - from.weights[k]);
            }
            clipped_.push_back(crossing);
        }
    }
    std::swap(polygon_, clipped_);
}

double LowerParts::area() const {
    double sum = 0;
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
        const auto& a = polygon_[0].weights;
        const auto& b = polygon_[i - 1].weights;
        const auto& c = polygon_[i].weights;
        sum += (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    }
    return std::abs(sum); // Twice the area, of a triangle with twice the area 1.
}

double LowerParts::share(std::span<const CornerValues> functions, std::size_t index, double band) {
    polygon_.assign({{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}});
    const CornerValues& own = functions[index];
    for (std::size_t other = 0; other < functions.size() && !polygon_.empty(); ++other) {
        const CornerValues& values = functions[other];
        if (other == index) {
            continue;
        }
        if (band == 0 && other < index && values == own) {
            return 0;
        }
        clip({values[0] - own[0] + band, values[1] - own[1] + band, values[2] - own[2] + band});
    }
    return area();
}

} // namespace geodisk
