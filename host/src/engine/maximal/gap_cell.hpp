// GapCell: a triangle that a face is split into, 1 to 4, any number of times.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace geodisk {

/// Maximum number of splits. A cell is then far smaller than the guard.
inline constexpr std::uint32_t kMaxSplits = 30;

/// The weights of the second and third corner of a face, at a point.
struct FaceWeights {
    double second, third;
};

/// A triangle in a face.
struct FacePart {
    std::uint32_t face;
    std::array<FaceWeights, 3> corners;
};

/// Corner weights of a cell are multiples of 2^-level: those of (column, row), one step further
/// along each weight. A cell is upright, as the face, or turned by half.
struct GapCell {
    std::uint32_t face;
    std::uint32_t column, row;
    std::uint8_t level;
    bool is_turned;

    double step() const { return 1.0 / static_cast<double>(std::uint64_t{1} << level); }

    FaceWeights centroid() const {
        const double part = is_turned ? 2.0 / 3 : 1.0 / 3;
        return {(column + part) * step(), (row + part) * step()};
    }

    std::array<FaceWeights, 3> corners() const {
        const double s = step();
        const double low = column * s, high = (column + 1.0) * s;
        const double bottom = row * s, top = (row + 1.0) * s;
        return is_turned ? std::array<FaceWeights, 3>{{{high, bottom}, {low, top}, {high, top}}}
                         : std::array<FaceWeights, 3>{{{low, bottom}, {high, bottom}, {low, top}}};
    }

    FacePart part() const { return {face, corners()}; }

    /// Returns the index of a child that has this point, which must be one of the cell.
    std::size_t child_with(const FaceWeights& point) const {
        const double steps = 2 / step();
        const double c = point.second * steps - 2.0 * column, r = point.third * steps - 2.0 * row;
        if (is_turned) {
            return r <= 1 ? 0 : c <= 1 ? 1 : c + r >= 3 ? 2 : 3;
        }
        return c >= 1 ? 1 : r >= 1 ? 2 : c + r <= 1 ? 0 : 3;
    }

    /// Returns the four cells that it splits into.
    std::array<GapCell, 4> children() const {
        const std::uint32_t c = 2 * column, r = 2 * row;
        const auto next = static_cast<std::uint8_t>(level + 1);
        return is_turned ? std::array<GapCell, 4>{{{face, c + 1, r, next, true},
                                                   {face, c, r + 1, next, true},
                                                   {face, c + 1, r + 1, next, true},
                                                   {face, c + 1, r + 1, next, false}}}
                         : std::array<GapCell, 4>{{{face, c, r, next, false},
                                                   {face, c + 1, r, next, false},
                                                   {face, c, r + 1, next, false},
                                                   {face, c, r, next, true}}};
    }
};

} // namespace geodisk
