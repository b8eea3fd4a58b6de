#include "geometry/texels.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/nearest_face.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

// Steps of rounded coordinates in a texel.
constexpr std::int64_t kTexelSteps = 256;

constexpr std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

constexpr std::int64_t wrapped(std::int64_t i, std::uint32_t count) {
    return i - floor_divided(i, count) * count;
}

/// A point of the texture in steps, from its upper left.
struct Spot {
    std::int64_t x, y;
};

/// Returns the centre of a texel.
constexpr std::int64_t centre(std::int64_t i) {
    return kTexelSteps * i + kTexelSteps / 2;
}

/// Columns from the first to the last, or none.
struct Columns {
    std::int64_t first, last;
};

/// A face in the texture. Sums and products of coordinates stay far below 2^63.
class TextureFace {
  public:
    TextureFace(const MeshFile& mesh, TextureSize size, std::uint32_t face) {
        const MeshField& uvs = *mesh.texture_uvs;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = std::size_t{3} * face + k;
            const std::size_t value = uvs.of == MeshField::Of::corners
                                          ? uvs.corners[corner]
                                          : mesh.corners_in_file()[corner];
            const double u = uvs.values[2 * value], v = uvs.values[2 * value + 1];
            is_repeating_ = is_repeating_ || u < 0 || u > 1 || v < 0 || v > 1;
            exact_[k] = {u * size.width, (uvs.is_from_top ? v : 1 - v) * size.height};
            corners_[k] = {std::llround(exact_[k].x * kTexelSteps),
                           std::llround(exact_[k].y * kTexelSteps)};
        }
        area_ = side(corners_[0], corners_[1], corners_[2]);
    }

    bool is_repeating() const { return is_repeating_; }
    std::int64_t area() const { return area_; }

    /// Returns the first and the last row with centres between the corners.
    Columns rows() const {
        const auto [low, high] = std::minmax({corners_[0].y, corners_[1].y, corners_[2].y});
        return {floor_divided(low - kTexelSteps / 2 + kTexelSteps - 1, kTexelSteps),
                floor_divided(high - kTexelSteps / 2, kTexelSteps)};
    }

    /// Returns the columns of a row whose centres it covers.
    Columns columns(std::int64_t row) const {
        const auto [low, high] = std::minmax({corners_[0].x, corners_[1].x, corners_[2].x});
        Columns found{floor_divided(low, kTexelSteps), floor_divided(high, kTexelSteps)};
        const std::size_t turned = area_ < 0 ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Spot a = corners_[(k + turned) % 3], b = corners_[(k + 1 - turned) % 3];
            keep_side(a, b, centre(row), found);
        }
        return found;
    }

    /// Returns the weights of the corners at the centre of a texel. They are those of coordinates
    /// that are not rounded; a centre just outside of these counts as the nearest point of them.
    std::array<double, 3> weights(std::int64_t column, std::int64_t row) const {
        const auto from_first = [this](ExactSpot spot) {
            return Vector{spot.x - exact_[0].x, spot.y - exact_[0].y};
        };
        const auto cross = [](const Vector& a, const Vector& b) {
            return a[0] * b[1] - a[1] * b[0];
        };
        const Vector ab = from_first(exact_[1]), ac = from_first(exact_[2]);
        const Vector to =
            from_first({static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
        const double area = cross(ab, ac), v = cross(to, ac) / area, w = cross(ab, to) / area;
        return v >= 0 && w >= 0 && v + w <= 1 ? std::array{1 - v - w, v, w}
                                              : nearest_weights(ab, ac, to); // Area 0 as well.
    }

  private:
    /// A point of the texture in texels, from its upper left.
    struct ExactSpot {
        double x, y;
    };

    /// Twice the area of a triangle: positive if `p` is to the side of the line that is kept.
    static std::int64_t side(Spot a, Spot b, Spot p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    }

    /// Leaves out what is on the wrong side of the line from a to b; of centres on it, one of its
    /// two directions keeps them.
    static void keep_side(Spot a, Spot b, std::int64_t y, Columns& columns) {
        const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
        const std::int64_t least = dy > 0 || (dy == 0 && dx > 0) ? 0 : 1;
        // side() in column c is at_first - step * c.
        const std::int64_t at_first = side(a, b, {centre(0), y}), step = dy * kTexelSteps;
        if (step > 0) {
            columns.last = std::min(columns.last, floor_divided(at_first - least, step));
        } else if (step < 0) {
            columns.first = std::max(columns.first, -floor_divided(at_first - least, -step));
        } else if (at_first < least) {
            columns.last = columns.first - 1;
        }
    }

    std::array<ExactSpot, 3> exact_{};
    std::array<Spot, 3> corners_{}; // Rounded.
    std::int64_t area_ = 0;
    bool is_repeating_ = false;
};

} // namespace

Texels::Texels(const MeshFile& mesh, TextureSize size)
    : mesh_(mesh), size_(size), faces_(size.texels(), kNone) {
    std::vector<bool> is_covered_again(size.texels());
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
        if (!mesh.takes_part(face)) {
            continue;
        }
        const TextureFace in_texture(mesh, size, face);
        repeating_ += std::uint64_t{in_texture.is_repeating()};
        if (in_texture.area() == 0) {
            continue;
        }
        const auto [first, last] = in_texture.rows();
        for (std::int64_t row = first; row <= last; ++row) {
            check_interrupted();
            const auto [left, right] = in_texture.columns(row);
            const auto start = static_cast<std::size_t>(wrapped(row, size.height)) * size.width;
            for (std::int64_t column = left; column <= right; ++column) {
                const std::size_t texel =
                    start + static_cast<std::size_t>(wrapped(column, size.width));
                if (faces_[texel] == kNone) {
                    faces_[texel] = face;
                    ++covered_;
                } else if (!is_covered_again[texel]) {
                    is_covered_again[texel] = true;
                    ++overlapping_;
                }
            }
        }
    }
}

std::array<float, 3> Texels::weights(std::size_t texel) const {
    const TextureFace face(mesh_, size_, faces_[texel]);
    const auto own_row = static_cast<std::int64_t>(texel / size_.width);
    const auto own_column = static_cast<std::int64_t>(texel % size_.width);
    const auto [first, last] = face.rows();
    // The first of the places where the texture repeats, as for faces().
    std::int64_t row = first + wrapped(own_row - first, size_.height), column = own_column;
    for (bool is_found = false; !is_found && row <= last;) {
        const auto [left, right] = face.columns(row);
        column = left + wrapped(own_column - left, size_.width);
        is_found = column <= right;
        row += is_found ? 0 : size_.height;
    }
    const auto parts = face.weights(column, row);
    constexpr double kOne = 0x1p24;
    double second = std::floor(parts[1] * kOne + 0.5);
    const double third = std::floor(parts[2] * kOne + 0.5);
    second = std::min(second, kOne - third); // Where both are rounded up.
    return {static_cast<float>((kOne - second - third) / kOne), static_cast<float>(second / kOne),
            static_cast<float>(third / kOne)};
}

} // namespace geodisk::tools
