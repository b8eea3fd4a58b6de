#include "analysis/evenness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geodisk::tools::analysis {
namespace {

/// Halves `faces` by area until there are `count` parts, the first of them number `first`.
void divide(std::span<std::uint32_t> faces, std::span<const double> centers,
            std::uint32_t dimension, std::span<const double> areas, std::uint32_t first,
            std::uint32_t count, Regions& regions) {
    if (count == 1) {
        for (const std::uint32_t face : faces) {
            regions.of_face[face] = first;
            regions.areas[first] += areas[face];
        }
        return;
    }
    const auto at = [&](std::uint32_t face, std::uint32_t axis) {
        return centers[std::size_t{face} * dimension + axis];
    };
    std::uint32_t longest = 0;
    double extent = -1;
    for (std::uint32_t axis = 0; axis < dimension; ++axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t face : faces) {
            low = std::min(low, at(face, axis));
            high = std::max(high, at(face, axis));
        }
        if (high - low > extent) {
            extent = high - low;
            longest = axis;
        }
    }
    std::sort(faces.begin(), faces.end(), [&](std::uint32_t a, std::uint32_t b) {
        return at(a, longest) != at(b, longest) ? at(a, longest) < at(b, longest) : a < b;
    });
    double all = 0;
    for (const std::uint32_t face : faces) {
        all += areas[face];
    }
    double half = 0;
    std::size_t middle = 0;
    while (middle < faces.size() && half + areas[faces[middle]] / 2 < all / 2) {
        half += areas[faces[middle++]];
    }
    divide(faces.first(middle), centers, dimension, areas, first, count / 2, regions);
    divide(faces.subspan(middle), centers, dimension, areas, first + count / 2, count / 2, regions);
}

} // namespace

Regions make_regions(std::span<const double> centers, std::uint32_t dimension,
                     std::span<const double> areas, std::uint32_t count) {
    Regions regions;
    regions.of_face.resize(areas.size());
    regions.areas.assign(count, 0);
    std::vector<std::uint32_t> faces(areas.size());
    std::iota(faces.begin(), faces.end(), 0u);
    divide(faces, centers, dimension, areas, 0, count, regions);
    return regions;
}

std::optional<Evenness> test_evenness(std::span<const std::vector<double>> counts,
                                      std::span<const double> areas) {
    Evenness result;
    result.sets = static_cast<std::uint32_t>(counts.size());
    result.regions = static_cast<std::uint32_t>(
        std::count_if(areas.begin(), areas.end(), [](double area) { return area > 0; }));
    if (result.sets < 2 || result.regions < 2) {
        return std::nullopt;
    }
    const double sets = result.sets;
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<double> means(areas.size(), 0); // Of what is more than the area's part.
    std::vector<double> expected(areas.size(), 0);
    std::vector<double> squares(areas.size(), 0);
    for (const std::vector<double>& set : counts) {
        const double all = std::accumulate(set.begin(), set.end(), 0.0);
        for (std::size_t region = 0; region < areas.size(); ++region) {
            const double part = all * areas[region] / area;
            const double more = set[region] - part;
            expected[region] += part / sets;
            means[region] += more / sets;
            squares[region] += more * more;
        }
    }
    double variance = 0, all = 0;
    for (std::size_t region = 0; region < areas.size(); ++region) {
        variance += (squares[region] - sets * means[region] * means[region]) / (sets - 1);
        all += expected[region];
    }
    if (!(variance > 0) || !(all > 0)) {
        return std::nullopt;
    }
    result.dispersion = variance / all;
    for (std::size_t region = 0; region < areas.size(); ++region) {
        if (expected[region] > 0) {
            result.chi_square +=
                sets * means[region] * means[region] / (result.dispersion * expected[region]);
        }
    }
    result.freedom = result.regions - 1;
    result.p = chi_square_tail(result.chi_square, result.freedom);
    return result;
}

double chi_square_tail(double chi_square, double freedom) {
    const double spread = 2 / (9 * freedom);
    const double normal = (std::cbrt(chi_square / freedom) - (1 - spread)) / std::sqrt(spread);
    return std::erfc(normal / std::sqrt(2.0)) / 2;
}

} // namespace geodisk::tools::analysis
