#include "baselines/phase_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>

#include "baselines/random.hpp"

namespace geodisk::ref {
namespace {

/// A candidate with its cell in space, sorted by group, then cell, then rank.
struct GroupedCandidate {
    std::int64_t group;
    std::array<std::int64_t, 3> cell;
    std::uint32_t rank;

    auto operator<=>(const GroupedCandidate&) const = default;
};

std::vector<GroupedCandidate> grouped(std::span<const glm::dvec3> positions, double side) {
    // The minimum distance is side * sqrt(3), so two cells between those of a group are enough.
    constexpr std::int64_t kPerAxis = 3;
    std::vector<GroupedCandidate> candidates;
    for (std::uint32_t rank = 0; rank < positions.size(); ++rank) {
        GroupedCandidate candidate{0, {}, rank};
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<std::int64_t>(std::floor(positions[rank][axis] / side));
            candidate.cell[static_cast<std::size_t>(axis)] = place;
            candidate.group = candidate.group * kPerAxis + (place % kPerAxis + kPerAxis) % kPerAxis;
        }
        candidates.push_back(candidate);
    }
    std::sort(candidates.begin(), candidates.end());
    return candidates;
}

/// Cells of one level in a box, all of one width, by group.
struct Level {
    double side;
    std::vector<std::size_t> counts; ///< Number of cells per axis.
    std::vector<std::vector<std::size_t>> groups;

    Level(const Box& box, double cell_side, double min_distance);

    std::vector<double> corner_of(std::size_t cell) const {
        std::vector<double> corner(counts.size());
        for (std::size_t axis = counts.size(); axis-- > 0; cell /= counts[axis]) {
            corner[axis] = static_cast<double>(cell % counts[axis]) * side;
        }
        return corner;
    }
    std::size_t cell_of(std::span<const double> point) const {
        std::size_t cell = 0;
        for (std::size_t axis = 0; axis < counts.size(); ++axis) {
            const auto place = static_cast<std::size_t>(point[axis] / side);
            cell = cell * counts[axis] + std::min(place, counts[axis] - 1);
        }
        return cell;
    }
};

Level::Level(const Box& box, double cell_side, double min_distance) : side(cell_side) {
    // The cells between two cells of a group are together at least as wide as the minimum distance.
    const std::size_t per_axis = 1 + static_cast<std::size_t>(std::ceil(min_distance / side));
    std::size_t cells = 1;
    std::size_t group_count = 1;
    for (const double length : box.sides) {
        counts.push_back(static_cast<std::size_t>(std::ceil(length / side)));
        cells *= counts.back();
        group_count *= per_axis;
    }
    groups.resize(group_count);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::size_t group = 0;
        std::size_t rest = cell;
        for (std::size_t axis = counts.size(); axis-- > 0; rest /= counts[axis]) {
            group = group * per_axis + rest % counts[axis] % per_axis;
        }
        groups[group].push_back(cell);
    }
}

/// Throws the darts of one level.
void throw_level(const Box& box, const Level& level, std::uint32_t trials, RandomStream& random,
                 BoxGrid& samples) {
    std::vector<bool> has_sample;
    for (const std::vector<std::size_t>& group : level.groups) {
        for (const std::size_t cell : group) {
            has_sample.resize(std::max(has_sample.size(), cell + 1), false);
        }
    }
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        has_sample[level.cell_of(samples.point(i))] = true;
    }
    for (const std::vector<std::size_t>& group : level.groups) {
        for (std::uint32_t trial = 0; trial < trials; ++trial) {
            for (const std::size_t cell : group) {
                if (has_sample[cell]) {
                    continue;
                }
                std::vector<double> dart = level.corner_of(cell);
                bool is_inside = true;
                for (std::size_t axis = 0; axis < dart.size(); ++axis) {
                    dart[axis] += random.uniform() * level.side;
                    is_inside = is_inside && dart[axis] < box.sides[axis];
                }
                if (is_inside && samples.is_free(dart)) {
                    samples.add(dart);
                    has_sample[cell] = true;
                }
            }
        }
    }
}

} // namespace

PhaseGroups::PhaseGroups(std::span<const glm::dvec3> positions, double min_distance) {
    const std::vector<GroupedCandidate> candidates =
        grouped(positions, min_distance / std::sqrt(3.0));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const bool is_first = i == 0;
        if (is_first || candidates[i].group != candidates[i - 1].group) {
            groups_.push_back(static_cast<std::uint32_t>(cells_.size()));
        }
        if (is_first || candidates[i].cell != candidates[i - 1].cell) {
            cells_.push_back(static_cast<std::uint32_t>(i));
        }
        ranks_.push_back(candidates[i].rank);
    }
    groups_.push_back(static_cast<std::uint32_t>(cells_.size()));
    cells_.push_back(static_cast<std::uint32_t>(candidates.size()));
}

std::vector<std::uint32_t> PhaseGroups::throw_darts(DiskQuery& disks, std::uint32_t trials) const {
    std::vector<std::uint32_t> accepted;
    std::vector<std::uint32_t> disk;
    std::vector<std::uint8_t> remains(disks.size(), 1);
    const auto throw_dart = [&](std::uint32_t rank) {
        if (!remains[rank]) {
            return;
        }
        remains[rank] = 0;
        accepted.push_back(rank);
        disks.find(rank, remains, disk);
        for (const std::uint32_t other : disk) {
            remains[other] = 0;
        }
    };
    for (std::size_t group = 0; group + 1 < groups_.size(); ++group) {
        std::vector<std::uint32_t> cells(groups_[group + 1] - groups_[group]);
        std::iota(cells.begin(), cells.end(), groups_[group]);
        for (std::uint32_t trial = 0; trial < trials && !cells.empty(); ++trial) {
            std::erase_if(cells, [&](std::uint32_t cell) {
                return cells_[cell] + trial >= cells_[std::size_t{cell} + 1];
            });
            for (const std::uint32_t cell : cells) {
                throw_dart(ranks_[cells_[cell] + trial]);
            }
        }
    }
    return accepted;
}

std::vector<double> throw_in_phase_groups(const Box& box, double min_distance, std::uint32_t trials,
                                          std::uint64_t seed) {
    const double finest = min_distance / std::sqrt(static_cast<double>(box.dimension()));
    const double longest = *std::max_element(box.sides.begin(), box.sides.end());
    double side = finest;
    while (side < longest) {
        side *= 2;
    }
    RandomStream random(seed);
    BoxGrid samples(box, min_distance);
    for (; side >= finest; side /= 2) {
        throw_level(box, Level(box, side, min_distance), trials, random, samples);
    }
    return samples.coordinates();
}

} // namespace geodisk::ref
