// CornerFunctions: the distances of samples in a part of a face as functions that are nearly
// linear.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/cells/lower_parts.hpp"
#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

/// The distance of one light in a cell, and its function.
struct CornerFunction {
    std::array<double, 3> distances; ///< At the corners.
    CornerValues values;             ///< Values of the function.
    double bend;                     ///< By how much that may be off from linear.
    std::uint32_t lit;               ///< Bit of each corner that is lit.

    static constexpr std::uint32_t kAllLit = 7;
    /// Returns true if `other` is lit all over the cell and below by more than `margin`.
    bool is_beaten_by(const CornerFunction& other, double margin) const {
        const double beyond = bend + other.bend + margin;
        return other.lit == kAllLit && values[0] > other.values[0] + beyond &&
               values[1] > other.values[1] + beyond && values[2] > other.values[2] + beyond;
    }
};

/// A distance d becomes the function (d - s)^2 - |p|^2, with s the least distance of a source and p
/// the place: linear where that source is the sample's, and as large where d is.
class CornerFunctions {
  public:
    CornerFunctions(const LitFaces& lit, const FacePart& part, const LitFaces::Target& target,
                    std::span<const std::uint32_t> lights);

    CornerFunction of(std::uint32_t light) const;
    double nearest_source() const { return nearest_source_; }
    /// Returns the difference of functions of distances up to this one that differ by so much.
    double difference(double distance, double by) const {
        return 2 * (distance + by - nearest_source_) * by;
    }

  private:
    const LitFaces& lit_;
    const LitFaces::Target& target_;
    std::array<LitFaces::Target, 3> corners_;
    std::array<double, 3> squares_;
    double nearest_source_;
};

} // namespace geodisk
