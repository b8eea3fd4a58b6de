#include "picture/nearest_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geodisk::tools::picture {
namespace {

/// Cells that a thread takes at a time.
constexpr std::size_t kBatch = 256;
/// What floats and the seams of windows change of a distance at most, in units.
constexpr double kSlack = 2e-3;
constexpr double kSeam = 2e-4; ///< As in surface.frag.

struct Point {
    double x, y;
};

/// Returns the part of a convex polygon where `along`(point) is at least 0.
template <class Along>
std::vector<Point> clipped(const std::vector<Point>& polygon, const Along& along) {
    std::vector<Point> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double at_a = along(a), at_b = along(b);
        if (at_a >= 0) {
            part.push_back(a);
        }
        if ((at_a < 0) != (at_b < 0)) {
            const double t = at_a / (at_a - at_b);
            part.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return part;
}

/// The part of a face in one of its cells: its middle, and how far from there it reaches.
struct Patch {
    Point middle{0, 0};
    double extent = std::numeric_limits<double>::infinity(); ///< If the face is not in the cell.

    Patch(const FaceRec& face, std::uint32_t column, std::uint32_t row) {
        std::vector<Point> part{{0, 0}, {face.longest, 0}, {face.apex_x, face.apex_y}};
        if (face.columns > 1 || face.rows > 1) {
            // The last cells have what lies beyond, by rounding.
            const double size = 1 / double{face.cells_per_unit};
            const double left = column * size, low = row * size;
            part = clipped(part, [&](Point p) { return p.x - left; });
            part = clipped(part, [&](Point p) { return p.y - low; });
            if (column + 1 < face.columns) {
                part = clipped(part, [&](Point p) { return left + size - p.x; });
            }
            if (row + 1 < face.rows) {
                part = clipped(part, [&](Point p) { return low + size - p.y; });
            }
        }
        if (part.empty()) {
            return;
        }
        for (const Point& corner : part) {
            middle.x += corner.x / static_cast<double>(part.size());
            middle.y += corner.y / static_cast<double>(part.size());
        }
        extent = 0;
        for (const Point& corner : part) {
            extent = std::max(extent, std::hypot(corner.x - middle.x, corner.y - middle.y));
        }
    }
};

/// The cells of a table, each with its windows. Every sample of a cell is a run of windows.
class Cells {
  public:
    Cells(const WindowTable& table, std::span<const double> radii, double reach, double margin)
        : table_(table), radii_(radii), reach_(reach), margin_(margin),
          is_kept_(table.windows.size(), 1) {}

    /// Decides which windows of the cells of a face are kept.
    void decide(const FaceRec& face) {
        for (std::uint32_t row = 0; row < face.rows; ++row) {
            for (std::uint32_t column = 0; column < face.columns; ++column) {
                decide(face.first_cell + row * face.columns + column, Patch(face, column, row));
            }
        }
    }

    bool is_kept(std::size_t window) const { return is_kept_[window] != 0; }

  private:
    /// A geodesic distance differs by no more between two places than these are apart. So from the
    /// distance at the middle follows what it is at least and at most anywhere in the patch.
    void decide(std::uint32_t cell, const Patch& patch) {
        const double extent = patch.extent + kSlack;
        double nearest = std::numeric_limits<double>::infinity(); // At most, in radii.
        for_samples(
            cell,
            [&](std::uint32_t, std::uint32_t, double distance, double radius) {
                nearest = std::min(nearest, (distance + extent) / radius);
            },
            patch.middle);
        for_samples(
            cell,
            [&](std::uint32_t begin, std::uint32_t end, double distance, double radius) {
                const double seen = std::min(distance, reach_ * radius); // At least.
                if ((seen - extent) / radius > nearest + margin_) {
                    std::fill(is_kept_.begin() + begin, is_kept_.begin() + end, std::uint8_t{0});
                }
            },
            patch.middle);
    }

    /// Calls `use(begin, end, distance, radius)` for the windows of each sample; the distance from
    /// `place` is infinite where none of them sees it.
    template <class Use>
    void for_samples(std::uint32_t cell, const Use& use, Point place) const {
        const std::uint32_t end = table_.starts[cell + 1];
        for (std::uint32_t begin = table_.starts[cell], next = begin; begin < end; begin = next) {
            const std::uint32_t sample = table_.windows[begin].sample_index;
            double distance = std::numeric_limits<double>::infinity();
            for (; next < end && table_.windows[next].sample_index == sample; ++next) {
                distance = std::min(distance, seen_from(table_.windows[next], place));
            }
            use(begin, next, distance, radii_[sample]);
        }
    }

    static double seen_from(const WindowRec& window, Point place) {
        const double x = place.x - double{window.x}, y = place.y - double{window.y};
        return double{window.left_x} * x + double{window.left_y} * y >= -kSeam &&
                       double{window.right_x} * x + double{window.right_y} * y >= -kSeam
                   ? double{window.sigma} + std::hypot(x, y)
                   : std::numeric_limits<double>::infinity();
    }

    const WindowTable& table_;
    std::span<const double> radii_;
    double reach_, margin_;
    std::vector<std::uint8_t> is_kept_;
};

} // namespace

void keep_nearest(WindowTable& table, std::span<const double> radii, double reach, double margin) {
    Cells cells(table, radii, reach, margin);
    const auto make_worker = [&] {
        return [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t face = begin; face < end; ++face) {
                cells.decide(table.faces[face]);
            }
        };
    };
    in_batches(table.faces.size(), kBatch, make_worker, {});
    std::uint32_t kept = 0;
    for (std::size_t cell = 0; cell + 1 < table.starts.size(); ++cell) {
        const std::uint32_t begin = table.starts[cell], end = table.starts[cell + 1];
        table.starts[cell] = kept;
        for (std::uint32_t i = begin; i < end; ++i) {
            if (cells.is_kept(i)) {
                table.windows[kept++] = table.windows[i];
            }
        }
    }
    table.starts.back() = kept;
    table.windows.resize(kept);
}

} // namespace geodisk::tools::picture
