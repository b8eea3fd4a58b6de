// How far conflicts may be from the faces of a part, where radii vary and no process holds the
// whole.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "parts/ranges/ranged_halo.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Bounds what reaches() does. Space is divided into cubes; each process tells which its faces
/// touch, and the largest radius there. No path is shorter than the gap between the cubes where it
/// ends.
class RangedReach {
  public:
    /// All processes make it.
    RangedReach(Talk& talk, const KnownSurface& known, double min_distance);

    /// Returns the largest bound on own faces, in minimum distances.
    double on_own() const { return on_own_; }
    /// Returns the largest bound on a face of any process.
    double on_face(const FacePlaces& places, std::size_t face);

  private:
    /// Number of a cube along each axis. Numbers are whole.
    using Cube = std::array<double, 3>;
    /// The lowest and highest numbers of some cubes.
    struct Box {
        Cube low, high;
    };

    Box box_of(const FacePlaces& places, std::size_t first_corner, std::size_t end) const;
    std::map<Cube, float> radii_of(const FacePlaces& places) const;
    double in_cube(const Cube& cube);

    double side_;
    double min_distance_;
    double on_own_ = 1;
    std::map<Cube, float> radii_;   ///< Largest in cubes that faces touch; empty if all are equal.
    std::map<Cube, double> bounds_; ///< Of the cubes that were asked for.
};

} // namespace geodisk
