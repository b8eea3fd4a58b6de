// LowerParts: which part of a triangle has which of some linear functions as the least.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace geodisk {

/// The values of a linear function at the corners of a triangle.
using CornerValues = std::array<double, 3>;

class LowerParts {
  public:
    /// Returns the part of the triangle's area, 0 to 1, where the function of this index exceeds no
    /// other by more than `band`, at least 0. Without a band the parts of all functions sum to 1;
    /// of equal functions the first has the part.
    double share(std::span<const CornerValues> functions, std::size_t index, double band);

  private:
    struct Vertex {
        std::array<double, 3> weights;
    };
    /// Keeps what is on the side where the function is not negative.
    void clip(const CornerValues& function);
    double area() const;

    std::vector<Vertex> polygon_, clipped_;
};

} // namespace geodisk
