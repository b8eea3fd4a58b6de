// Phase groups: cells so far apart that their darts cannot conflict are processed at the same time,
// group after group in a fixed order. Here they are processed sequentially, with the same result.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "baselines/box.hpp"
#include "baselines/disk_query.hpp"

namespace geodisk::ref {

/// On surfaces (Bowers, Wang, Wei and Maletz, "Parallel Poisson disk sampling with spectrum
/// analysis on surfaces", 2010): cells of space with the minimum distance as diagonal, in 3 x 3 x 3
/// groups.
class PhaseGroups {
  public:
    /// Sorts a pool, given by its positions in space, into cells.
    PhaseGroups(std::span<const glm::dvec3> positions, double min_distance);

    /// Throws darts group by group. Each cell throws one dart per trial, its next candidate in rank
    /// order, until it has none left. A dart removed by an accepted one costs its trial. `disks`
    /// has the same pool and minimum distance, and no distance shorter than in space. Returns the
    /// ranks in the order of acceptance.
    std::vector<std::uint32_t> throw_darts(DiskQuery& disks, std::uint32_t trials) const;

  private:
    std::vector<std::uint32_t> ranks_;  ///< Ranks by group, then cell, ascending in each.
    std::vector<std::uint32_t> cells_;  ///< Start of each cell in `ranks_`, and the end of all.
    std::vector<std::uint32_t> groups_; ///< Start of each group in `cells_`, and the end of all.
};

/// In a box (Wei, "Parallel Poisson disk sampling", 2008): level by level, from one cell around the
/// box to cells with the minimum distance as diagonal, each cell without a sample throws up to
/// `trials` darts, group by group. Returns the coordinates, point after point, in the order
/// accepted. The box must not be periodic.
std::vector<double> throw_in_phase_groups(const Box& box, double min_distance, std::uint32_t trials,
                                          std::uint64_t seed);

} // namespace geodisk::ref
