#include "baselines/box_darts.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/random.hpp"

namespace geodisk::ref {
namespace {

void draw_in(std::span<const double> corner, std::span<const double> sides, RandomStream& random,
             std::vector<double>& point) {
    point.resize(corner.size());
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
        point[axis] = corner[axis] + random.uniform() * sides[axis];
    }
}

/// Moves coordinates outside a periodic box by its side. Returns true if the point is then inside.
bool bring_inside(const Box& box, std::span<double> point) {
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
        const double side = box.sides[axis];
        if (box.is_periodic) {
            point[axis] -= side * std::floor(point[axis] / side);
        }
        // Rounding may give the side itself.
        if (!(point[axis] >= 0 && point[axis] < side)) {
            return false;
        }
    }
    return true;
}

/// Draws a point at distance 1 to 2 from the origin, uniform by volume.
void draw_in_shell(RandomStream& random, std::vector<double>& point) {
    double sum = 0;
    do {
        sum = 0;
        for (double& x : point) {
            x = 4 * random.uniform() - 2;
            sum += x * x;
        }
    } while (sum < 1 || sum >= 4);
}

/// Cells of one width that may still take a dart, given by the corner next to the origin.
struct OpenCells {
    std::vector<double> sides;
    std::vector<double> corners;

    std::size_t size() const { return corners.size() / sides.size(); }
    std::span<const double> corner(std::size_t cell) const {
        return std::span(corners).subspan(cell * sides.size(), sides.size());
    }
    void remove(std::size_t cell) {
        std::copy(corners.end() - static_cast<std::ptrdiff_t>(sides.size()), corners.end(),
                  corners.begin() + static_cast<std::ptrdiff_t>(cell * sides.size()));
        corners.resize(corners.size() - sides.size());
    }
};

/// Returns true if the cell lies in the disk of one sample.
bool is_covered(const BoxGrid& samples, double min_distance, std::span<const double> corner,
                std::span<const double> sides) {
    std::vector<double> center(corner.begin(), corner.end());
    for (std::size_t axis = 0; axis < center.size(); ++axis) {
        center[axis] += 0.5 * sides[axis];
    }
    bool covered = false;
    samples.for_near(center, [&](std::uint32_t i) {
        double farthest2 = 0;
        for (std::size_t axis = 0; axis < center.size(); ++axis) {
            double d = std::abs(center[axis] - samples.point(i)[axis]);
            d = samples.box().is_periodic ? std::min(d, samples.box().sides[axis] - d) : d;
            farthest2 += (d + 0.5 * sides[axis]) * (d + 0.5 * sides[axis]);
        }
        covered = farthest2 < min_distance * min_distance;
        return !covered;
    });
    return covered;
}

/// Returns those of the 2^n parts of each cell that no sample covers.
OpenCells cut(const OpenCells& cells, const BoxGrid& samples, double min_distance) {
    OpenCells parts;
    for (const double side : cells.sides) {
        parts.sides.push_back(0.5 * side);
    }
    std::vector<double> corner(parts.sides.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        for (std::uint32_t part = 0; part < 1u << corner.size(); ++part) {
            for (std::size_t axis = 0; axis < corner.size(); ++axis) {
                corner[axis] =
                    cells.corner(cell)[axis] + (part >> axis & 1 ? parts.sides[axis] : 0.0);
            }
            if (!is_covered(samples, min_distance, corner, parts.sides)) {
                parts.corners.insert(parts.corners.end(), corner.begin(), corner.end());
            }
        }
    }
    return parts;
}

/// Returns all cells of the box, with sides of at most `side`.
OpenCells all_cells(const Box& box, double side) {
    OpenCells cells;
    std::vector<std::size_t> counts;
    std::size_t count = 1;
    for (const double length : box.sides) {
        counts.push_back(static_cast<std::size_t>(std::ceil(length / side)));
        cells.sides.push_back(length / static_cast<double>(counts.back()));
        count *= counts.back();
    }
    for (std::size_t cell = 0; cell < count; ++cell) {
        std::size_t rest = cell;
        for (std::size_t axis = 0; axis < counts.size(); rest /= counts[axis++]) {
            cells.corners.push_back(static_cast<double>(rest % counts[axis]) * cells.sides[axis]);
        }
    }
    return cells;
}

} // namespace

std::vector<double> draw_points(const Box& box, std::uint32_t count, std::uint64_t seed) {
    RandomStream random(seed);
    std::vector<double> points;
    points.reserve(std::size_t{count} * box.dimension());
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const double side : box.sides) {
            points.push_back(random.uniform() * side);
        }
    }
    return points;
}

std::vector<double> throw_around_samples(const Box& box, double min_distance, std::uint32_t trials,
                                         std::uint64_t seed) {
    RandomStream random(seed);
    BoxGrid samples(box, min_distance);
    std::vector<double> dart;
    draw_in(std::vector<double>(box.dimension(), 0.0), box.sides, random, dart);
    samples.add(dart);
    std::vector<std::uint32_t> active{0};
    while (!active.empty()) {
        const std::uint32_t place = random.below(static_cast<std::uint32_t>(active.size()));
        bool is_accepted = false;
        for (std::uint32_t trial = 0; trial < trials && !is_accepted; ++trial) {
            draw_in_shell(random, dart);
            for (std::size_t axis = 0; axis < dart.size(); ++axis) {
                dart[axis] = samples.point(active[place])[axis] + dart[axis] * min_distance;
            }
            is_accepted = bring_inside(box, dart) && samples.is_free(dart);
        }
        if (is_accepted) {
            active.push_back(samples.size());
            samples.add(dart);
        } else {
            active[place] = active.back();
            active.pop_back();
        }
    }
    return samples.coordinates();
}

std::vector<double> throw_until_maximal(const Box& box, double min_distance, std::uint64_t seed) {
    // Cells of 2^-40 of the first width are below the resolution of coordinates.
    constexpr int kMaxCuts = 40;
    RandomStream random(seed);
    BoxGrid samples(box, min_distance);
    OpenCells cells =
        all_cells(box, min_distance / std::sqrt(static_cast<double>(box.dimension())));
    std::vector<double> dart;
    for (int cuts = 0; cells.size() > 0 && cuts < kMaxCuts; ++cuts) {
        for (std::size_t darts = cells.size(); darts > 0 && cells.size() > 0; --darts) {
            const std::size_t cell = random.below(static_cast<std::uint32_t>(cells.size()));
            draw_in(cells.corner(cell), cells.sides, random, dart);
            if (bring_inside(box, dart) && samples.is_free(dart)) {
                samples.add(dart);
                cells.remove(cell);
            }
        }
        cells = cut(cells, samples, min_distance);
    }
    return samples.coordinates();
}

} // namespace geodisk::ref
