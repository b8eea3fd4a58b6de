#include "bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodisk::bench {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<PowerLaw> fit_power_law(std::span<const Point> points) {
    std::vector<Point> logs;
    Point mean{0, 0};
    double from = std::numeric_limits<double>::infinity();
    for (const Point& point : points) {
        if (point.x > 0 && point.y > 0) {
            from = std::min(from, point.x);
            logs.push_back({std::log(point.x), std::log(point.y)});
            mean.x += logs.back().x;
            mean.y += logs.back().y;
        }
    }
    const auto count = static_cast<double>(logs.size());
    mean = {mean.x / count, mean.y / count};
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Point& log : logs) {
        xx += (log.x - mean.x) * (log.x - mean.x);
        xy += (log.x - mean.x) * (log.y - mean.y);
        yy += (log.y - mean.y) * (log.y - mean.y);
    }
    // Equal x leave at most what rounding of their mean makes of them.
    constexpr double kNoSpread = 1e-20;
    if (!(xx > kNoSpread)) {
        return std::nullopt;
    }
    PowerLaw law;
    law.exponent = xy / xx;
    law.factor = std::exp(mean.y - law.exponent * mean.x);
    law.r_squared = yy > kNoSpread ? xy * xy / (xx * yy) : 1;
    law.points = logs.size();
    law.from = from;
    return law;
}

std::optional<PowerLaw> fit_rise(std::span<const Point> points) {
    const auto least = std::min_element(points.begin(), points.end(),
                                        [](const Point& a, const Point& b) { return a.y < b.y; });
    const std::size_t last_step = points.size() - std::min<std::size_t>(points.size(), 2);
    return fit_power_law(
        points.subspan(std::min(static_cast<std::size_t>(least - points.begin()), last_step)));
}

} // namespace geodisk::bench
