// Surroundings: the surface around samples that changed, as far as others may change with them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/sample.hpp>

#include "engine/domain/drawn.hpp"
#include "parts/part.hpp"

namespace geodisk {

/// Samples that are settled, and their classes; those may be empty.
struct Settled {
    std::vector<Sample> samples;
    std::vector<std::uint8_t> classes;
};

/// Candidates within a width of what changed are decided anew. Samples a little farther away reject
/// some of them, and stay as they are: a change goes on from candidate to candidate, but hardly
/// ever so far.
class Surroundings {
  public:
    /// Looks around some faces of a part, given by their places. Vertices are known to be at least
    /// so far away; empty if that is not known. The part must outlive it.
    Surroundings(const Part& part, std::span<const std::uint32_t> faces,
                 std::span<const double> at_least = {});

    /// Returns the faces of the part that disks of all these candidates cross, by their places.
    const std::vector<std::uint32_t>& faces() const { return faces_; }
    /// Returns false if there may be more of them: where faces are very large.
    bool is_complete() const { return reach_ + part_.reach <= searched_; }

    /// Returns true if a candidate is decided anew.
    bool is_within(const DrawnCandidate& dart) const { return distance(dart) <= width_; }
    /// Returns true if such a candidate may be too close to one that is decided anew.
    bool is_reached(const DrawnCandidate& dart) const { return distance(dart) <= reach_; }
    /// Returns true if a candidate that is not decided anew may be too close to this one.
    bool reaches_others(const DrawnCandidate& dart) const;
    /// Returns the settled samples that are reached, on a part of these surroundings.
    Settled settled(const Settled& all, const Part& around) const;

    /// Returns lower bounds on the distances of vertices, linear in faces.
    const std::vector<double>& distances() const { return distances_; }
    /// Returns those of the vertices of a part of these surroundings.
    std::vector<double> distances_on(const Part& around) const;

  private:
    double nearest(std::uint32_t face) const;
    double farthest(std::uint32_t face) const;
    double distance(const DrawnCandidate& dart) const;

    const Part& part_;
    double width_, searched_, reach_;
    std::vector<double> distances_;
    std::vector<std::uint32_t> faces_;
};

} // namespace geodisk
