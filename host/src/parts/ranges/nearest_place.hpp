// NearestPlace: how far points in space are from the nearest of some.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace geodisk {

/// A point in space.
using Place = std::array<double, 3>;

/// A k-d tree, whose axes alternate.
class NearestPlace {
  public:
    explicit NearestPlace(std::vector<Place> places);

    /// Returns the distance to the nearest place, or `most` if none is nearer.
    double distance(const Place& from, double most) const;

  private:
    void sort(std::size_t begin, std::size_t end, std::size_t axis);
    void search(std::size_t begin, std::size_t end, std::size_t axis, const Place& from,
                double& least) const;

    std::vector<Place> places_; ///< The middle of a range divides it.
};

} // namespace geodisk
