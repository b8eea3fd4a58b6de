#include "kernels/box_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "geodisk/detail/uninitialized.hpp"
#include "kernels/dart_order.hpp"
#include "kernels/poisson.hpp"
#include "lib/rng.hpp"

namespace geodisk::ref {
namespace {

constexpr std::uint64_t kWholeAxis = std::uint64_t{1} << 32;
/// Counter for the seed of a cell.
constexpr std::uint32_t kCellCounter = 0xB0C5;
/// Takes the place of a candidate's index in the counter for the number of candidates of a cell.
constexpr std::uint32_t kBoxCountCounter = 0xffffffff;
/// Shorter sides count as one step of the unit.
constexpr double kShortestSide = 0x1p-31;
/// Samples per box of side D far from any border, by dimension (host/docs/boxes.md).
constexpr double kDensities[gpu::kMaxAxes] = {0.726, 0.601, 0.540, 0.523, 0.545, 0.597};
/// Apparent extra width of an open box at each end, in distances.
constexpr double kOverhangs[gpu::kMaxAxes] = {0.281, 0.295, 0.280, 0.262, 0.245, 0.237};

/// Returns a width or length modulo 2^32.
std::uint32_t wrapped(std::uint64_t steps) {
    return static_cast<std::uint32_t>(steps);
}

LatticeAxis periodic_axis(double extent, double width_of_cell) {
    const double cells = std::max(1.0, std::floor(extent / width_of_cell));
    const auto count = static_cast<std::uint32_t>(cells);
    const std::uint64_t width = kWholeAxis / count;
    return {extent * 0x1p-32, kWholeAxis, count, wrapped(width),
            wrapped(kWholeAxis - (count - 1) * width)};
}

/// Returns the number of bits of a coordinate within a unit.
int unit_bits(double side) {
    if (side < 1) {
        return 31;
    }
    return side < 65536 ? 16 : 16 - static_cast<int>(std::ceil(std::log2(side / 65536)));
}

LatticeAxis open_axis(double extent, double unit, int doublings) {
    const int bits = unit_bits(extent / unit);
    const double length = std::max(1.0, std::floor(std::ldexp(extent / unit, bits)));
    const auto steps = static_cast<std::uint64_t>(length);
    const std::uint64_t width = std::uint64_t{1} << std::min(31, bits + doublings);
    const std::uint64_t cells = (steps + width - 1) / width;
    return {std::ldexp(unit, -bits), steps, static_cast<std::uint32_t>(cells), wrapped(width),
            wrapped(steps - (cells - 1) * width)};
}

/// Returns the volume in units of the lattice.
double volume_of(const BoxParams& box) {
    const double unit = box_unit(box);
    double volume = 1;
    for (const double side : box.extents) {
        volume *= std::max(side / unit, kShortestSide);
    }
    return volume;
}

/// Returns the expected samples per unit of volume. In short boxes, whose borders hold more, it is
/// larger by a power of two, so that boxes of similar size have the same candidates.
double sample_density(const BoxParams& box, double volume) {
    const std::size_t axis = box.extents.size() - 1;
    const double density = kDensities[axis];
    const double overhang = box.is_periodic ? 0 : 2 * kOverhangs[axis];
    double samples = density;
    for (const double side : box.extents) {
        samples *= side / box_unit(box) + overhang;
    }
    const double more = std::log2(std::max(1.0, samples) / (density * volume));
    return density * std::exp2(std::max(0.0, std::round(more)));
}

/// Returns how often the cells double their width, so that 2^23 darts are enough for five per
/// sample in all cells.
int cell_doublings(const BoxParams& box) {
    const StageRule stages = stages_in(box);
    int halvings = 0;
    while (stages.darts != 0 && std::ldexp(5 * stages.samples, -halvings) > 0x1p23) {
        ++halvings;
    }
    const int dimensions = static_cast<int>(box.extents.size());
    return (halvings + dimensions - 1) / dimensions;
}

using Cell = std::array<std::uint32_t, gpu::kMaxAxes>;

std::uint64_t seed_of(const std::array<std::uint32_t, 4>& words) {
    return words[0] | std::uint64_t{words[1]} << 32;
}

std::uint64_t cell_seed(std::uint64_t seed, const Cell& cell, std::size_t dimension) {
    const std::uint64_t first = seed_of(philox(seed, {cell[0], cell[1], cell[2], kCellCounter}));
    return dimension > 3 ? seed_of(philox(first, {cell[3], cell[4], cell[5], kCellCounter}))
                         : first;
}

std::uint32_t width_of(const LatticeAxis& axis, std::uint32_t cell) {
    return cell + 1 == axis.cells ? axis.last_width : axis.width;
}

float float_of(std::uint32_t width) {
    return width == 0
               ? 4294967296.0f
               : static_cast<float>(width >> 16) * 65536.0f + static_cast<float>(width & 65535u);
}

/// Returns the expected candidates of a cell per stage.
float mean_of(const BoxLattice& lattice, std::span<const float> steps, const Cell& cell,
              float intensity) {
    float mean = intensity;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        mean = mean * (float_of(width_of(lattice.axes[i], cell[i])) * steps[i]);
    }
    return mean;
}

struct BoxDraw {
    std::uint32_t priority;
    BoxPoint point;
};

BoxDraw draw_candidate(const BoxLattice& lattice, const Cell& cell, std::uint64_t seed,
                       std::uint32_t stage, std::uint32_t k) {
    const std::size_t dimension = lattice.axes.size();
    const auto first = philox(seed, {k, stage, 0, 0});
    std::array<std::uint32_t, 4> second{};
    if (dimension > 3) {
        second = philox(seed, {k, stage, 1, 0});
    }
    const BoxPoint words{first[1], first[2], first[3], second[0], second[1], second[2]};
    BoxDraw draw{first[0] >> (32 - kPriorityBits), {}};
    for (std::size_t i = 0; i < dimension; ++i) {
        const LatticeAxis& axis = lattice.axes[i];
        const std::uint32_t width = width_of(axis, cell[i]);
        const std::uint32_t inside =
            width == 0 ? words[i]
                       : static_cast<std::uint32_t>(std::uint64_t{words[i]} * width >> 32);
        draw.point[i] = cell[i] * axis.width + inside;
    }
    return draw;
}

/// Moves to the next cell, with the first axis running fastest.
void advance(Cell& cell, const BoxLattice& lattice) {
    for (std::size_t i = 0; i < lattice.axes.size() && ++cell[i] == lattice.axes[i].cells; ++i) {
        cell[i] = 0;
    }
}

/// Appends the candidates of a stage in dart order.
void draw_stage(const BoxParams& box, const BoxLattice& lattice, std::uint32_t stage,
                BoxCandidates& candidates) {
    const float intensity = stage_intensity(box, stage);
    std::vector<float> steps;
    for (std::size_t i = 0; i < lattice.axes.size(); ++i) {
        steps.push_back(static_cast<float>(lattice.relative_step(i)));
    }
    std::vector<BoxPoint> points;
    std::vector<Dart> darts;
    // Mostly a little more than needed.
    const double expected = 1.01 * static_cast<double>(intensity) * volume_of(box);
    points.reserve(static_cast<std::size_t>(expected));
    darts.reserve(static_cast<std::size_t>(expected));
    Cell cell{};
    for (std::uint64_t i = lattice.cell_count(); i > 0; --i, advance(cell, lattice)) {
        const std::uint64_t seed = cell_seed(box.seed, cell, lattice.axes.size());
        const auto random = philox(seed, {kBoxCountCounter, stage, 0, 0});
        const std::uint32_t count =
            poisson(mean_of(lattice, steps, cell, intensity), random[0], random[1]);
        for (std::uint32_t k = 0; k < count; ++k) {
            const BoxDraw draw = draw_candidate(lattice, cell, seed, stage, k);
            darts.push_back(make_dart(draw.priority, static_cast<std::uint32_t>(points.size())));
            points.push_back(draw.point);
        }
    }
    UninitializedVector<Dart> scratch(darts.size());
    for (const Dart dart : sort_darts(darts, scratch)) {
        candidates.points.push_back(points[candidate_of(dart)]);
        candidates.words.push_back(order_word(stage, priority_of(dart)));
    }
}

} // namespace

double box_unit(const BoxParams& box) {
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double sum = 0;
    for (const double side : box.extents) {
        sum += (side / longest) * (side / longest);
    }
    return std::min(box.min_distance, 1.01 * longest * std::sqrt(sum));
}

BoxLattice::BoxLattice(const BoxParams& box) : unit(box_unit(box)), is_periodic(box.is_periodic) {
    const int doublings = cell_doublings(box);
    for (const double extent : box.extents) {
        axes.push_back(box.is_periodic ? periodic_axis(extent, std::ldexp(unit, doublings))
                                       : open_axis(extent, unit, doublings));
    }
}

BoxLattice BoxLattice::finest(const BoxParams& box) {
    BoxLattice lattice(box);
    for (std::size_t i = 0; i < lattice.axes.size(); ++i) {
        lattice.axes[i] = {box.extents[i] * 0x1p-32, kWholeAxis, 1, 0, 0};
    }
    return lattice;
}

std::uint64_t BoxLattice::cell_count() const {
    std::uint64_t count = 1;
    for (const LatticeAxis& axis : axes) {
        count *= axis.cells;
    }
    return count;
}

StageRule stages_in(const BoxParams& box) {
    const double volume = volume_of(box);
    return StageRule::of(sample_density(box, volume) * volume, box.pool_ratio, box.darts);
}

float stage_intensity(const BoxParams& box, std::uint32_t stage) {
    return static_cast<float>(stages_in(box).per_sample(stage) *
                              sample_density(box, volume_of(box)));
}

BoxCandidates draw_in_box(const BoxParams& box) {
    const BoxLattice lattice(box);
    const StageRule stages = stages_in(box);
    BoxCandidates candidates;
    const bool is_pool = stages.darts == 0;
    for (std::uint32_t stage = 0;
         is_pool ? stage < stages.pool_stages() : candidates.points.size() < stages.darts;
         ++stage) {
        draw_stage(box, lattice, stage, candidates);
    }
    if (!is_pool) {
        candidates.points.resize(stages.darts);
        candidates.words.resize(stages.darts);
    }
    return candidates;
}

} // namespace geodisk::ref
