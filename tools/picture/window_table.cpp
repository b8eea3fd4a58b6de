#include "picture/window_table.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools::picture {
namespace {

constexpr double kMaxCells = 0x1p24;
/// Sources that a thread takes at a time.
constexpr std::size_t kBatch = 64;

using Point = ref::Position<double>;

/// Ends the work of all threads.
struct TooManyWindows {};

/// A window and the cell it lights.
struct Placed {
    std::uint32_t cell;
    WindowRec window;
};

float to_float(double x) {
    return static_cast<float>(x);
}

/// Makes the windows of one source after the other.
class WindowMaker {
  public:
    WindowMaker(const ref::Surface<double>& surface, std::span<const FaceRec> faces)
        : surface_(surface), faces_(faces), detector_(surface, bins_, ref::double_tolerances(), 1) {
    }

    /// Appends those of the disk of radius `reach`, in units, to `out`.
    void make(std::uint32_t index, ref::FacePoint<double> source, double reach,
              std::vector<Placed>& out) {
        index_ = index;
        reach_ = reach;
        out_ = &out;
        detector_.set_limit(reach);
        detector_.spread(source, *this);
    }

    // Takes what Detector::spread() reports.
    void face(std::uint32_t h, double x, double y, double sigma) const {
        const std::uint32_t base = base_of(h);
        const Point source = ref::in_other_frame(surface_, h, base, Point{x, y});
        place(h / 3, source, sigma, Point{0, 0}, Point{0, 0});
    }
    void wedge(std::uint32_t h, double x, double y, double b0, double b1, double sigma) const {
        if (!(y > 0)) { // On the line of h: it sees all of the face or nothing of it.
            if (b0 <= x && x <= b1) {
                face(h, x, 0, sigma);
            }
            return;
        }
        const std::uint32_t base = base_of(h);
        const auto in_base = [&](double px, double py) {
            return ref::in_other_frame(surface_, h, base, Point{px, py});
        };
        const Point source = in_base(x, -y);
        const Point from = in_base(b0, 0);
        const Point to = in_base(b1, 0);
        // Seen points are to the right of the ray through b0 and to the left of that through b1.
        place(h / 3, source, sigma, unit_vector(from.y - source.y, source.x - from.x),
              unit_vector(source.y - to.y, to.x - source.x));
    }

  private:
    static Point unit_vector(double x, double y) {
        const double size = std::hypot(x, y);
        return {x / size, y / size};
    }

    std::uint32_t base_of(std::uint32_t h) const { return 3 * (h / 3) + faces_[h / 3].base; }

    /// The window lights each cell of the face that it sees anything of.
    void place(std::uint32_t f, Point source, double sigma, Point left, Point right) const {
        const FaceRec& face = faces_[f];
        const double rest = reach_ - sigma;
        const WindowRec window{
            to_float(source.x), to_float(source.y), to_float(sigma),   index_,
            to_float(left.x),   to_float(left.y),   to_float(right.x), to_float(right.y)};
        if (face.columns == 1 && face.rows == 1) {
            out_->push_back({face.first_cell, window});
            return;
        }
        const double size = 1 / static_cast<double>(face.cells_per_unit);
        const auto cell_at = [size](double x, std::uint32_t count) {
            return static_cast<std::uint32_t>(std::clamp(x / size, 0.0, count - 1.0));
        };
        const std::uint32_t last_row = cell_at(source.y + rest, face.rows);
        const std::uint32_t last_column = cell_at(source.x + rest, face.columns);
        for (std::uint32_t row = cell_at(source.y - rest, face.rows); row <= last_row; ++row) {
            for (std::uint32_t column = cell_at(source.x - rest, face.columns);
                 column <= last_column; ++column) {
                // A little larger than it is, for the rounding of the shader.
                const double grown = size * (1 + 1e-3);
                const Point middle{(column + 0.5) * size - source.x, (row + 0.5) * size - source.y};
                const double dx = std::max(0.0, std::abs(middle.x) - grown / 2);
                const double dy = std::max(0.0, std::abs(middle.y) - grown / 2);
                if (dx * dx + dy * dy <= rest * rest && sees(left, middle, grown) &&
                    sees(right, middle, grown)) {
                    out_->push_back({face.first_cell + row * face.columns + column, window});
                }
            }
        }
    }

    /// Returns true if a square around `middle` has points on the side of `normal`.
    static bool sees(Point normal, Point middle, double size) {
        return normal.x * middle.x + normal.y * middle.y +
                   (std::abs(normal.x) + std::abs(normal.y)) * size / 2 >=
               0;
    }

    const ref::Surface<double>& surface_;
    std::span<const FaceRec> faces_;
    ref::Bins<double> bins_; ///< Empty: nothing is looked up.
    ref::Detector<double, false> detector_;
    std::uint32_t index_ = 0;
    double reach_ = 0;
    std::vector<Placed>* out_ = nullptr;
};

std::vector<FaceRec> lay_out(const ref::Surface<double>& surface) {
    ref::Bins<double> bins;
    bins.lay_out(surface);
    std::vector<FaceRec> faces;
    faces.reserve(surface.face_count());
    for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
        const ref::Grid& grid = bins.grids[f];
        const ref::Edge<double>& edge = surface.edges[grid.base];
        faces.push_back({to_float(edge.length), to_float(edge.apex_x), to_float(edge.apex_y),
                         grid.base - 3 * f, to_float(surface.cells_per_unit(f)), grid.columns,
                         grid.rows, grid.first_cell});
    }
    return faces;
}

/// Sorts the windows by cell; within a cell they stay in order.
void sort_by_cell(std::vector<std::vector<Placed>>& batches, std::size_t cells,
                  WindowTable& table) {
    table.starts.assign(cells + 1, 0);
    for (const auto& batch : batches) {
        for (const Placed& placed : batch) {
            ++table.starts[placed.cell + 1];
        }
    }
    std::partial_sum(table.starts.begin(), table.starts.end(), table.starts.begin());
    table.windows.resize(table.starts.back());
    std::vector<std::uint32_t> cursor(table.starts.begin(), table.starts.end() - 1);
    for (auto& batch : batches) {
        for (const Placed& placed : batch) {
            table.windows[cursor[placed.cell]++] = placed.window;
        }
        batch = {};
    }
}

} // namespace

WindowTable make_window_table(const PreparedMesh& mesh, std::span<const SurfaceDisk> disks,
                              double spacing, const PartDone& tell, std::size_t most) {
    std::optional<WindowTable> table = try_window_table(mesh, disks, spacing, tell, most);
    if (!table) {
        throw UserError(ExitCode::out_of_memory,
                        "the disks light more than " + grouped(most) +
                            " places of the surface, too many for a picture; disks, points or a "
                            "smaller radius light fewer");
    }
    return std::move(*table);
}

std::optional<WindowTable> try_window_table(const PreparedMesh& mesh,
                                            std::span<const SurfaceDisk> disks, double spacing,
                                            const PartDone& tell, std::size_t most) {
    const ref::Surface<double> surface(mesh, ref::suitable_unit(mesh, spacing, kMaxCells));
    WindowTable table;
    table.unit = surface.frame.unit;
    table.faces = lay_out(surface);
    const FaceRec& last = table.faces.back();
    const std::size_t cells = last.first_cell + std::size_t{last.columns} * last.rows;

    std::vector<std::vector<Placed>> batches(batch_count(disks.size(), kBatch));
    std::atomic<std::size_t> windows = 0;
    const auto make_worker = [&] {
        return [&, maker = WindowMaker(surface, table.faces)](std::size_t batch, std::size_t begin,
                                                              std::size_t end) mutable {
            std::vector<Placed>& placed = batches[batch];
            for (std::size_t i = begin; i < end; ++i) {
                const SurfaceDisk& disk = disks[i];
                const std::size_t before = placed.size();
                maker.make(static_cast<std::uint32_t>(i), {disk.face, disk.weight1, disk.weight2},
                           disk.radius / surface.frame.unit, placed);
                if ((windows += placed.size() - before) > most) {
                    throw TooManyWindows();
                }
            }
        };
    };
    try {
        in_batches(disks.size(), kBatch, make_worker, tell);
    } catch (const TooManyWindows&) {
        return std::nullopt;
    } catch (const ref::EndlessDisk& error) {
        throw UserError(ExitCode::bad_input, error.what());
    }
    sort_by_cell(batches, cells, table);
    return table;
}

} // namespace geodisk::tools::picture
