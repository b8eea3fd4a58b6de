#include "report/disk_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace geodisk::tools::report {
namespace {

using picture::FaceRec;
using picture::WindowRec;
using picture::WindowTable;

/// Steps of a full turn.
constexpr double kAngles = 65534;
/// Amount of the shader's own rounding, in float, in units.
constexpr double kFloatSeam = 2e-4;

/// 0 for the vector of no length.
std::uint32_t angle_of(double x, double y) {
    if (x == 0 && y == 0) {
        return 0;
    }
    const double turns = std::atan2(y, x) / (2 * std::numbers::pi);
    const auto angle =
        static_cast<std::uint32_t>(std::lround((turns < 0 ? turns + 1 : turns) * kAngles));
    return 1 + angle % static_cast<std::uint32_t>(kAngles);
}

void add_faces(const WindowTable& table, std::vector<PageArray>& arrays) {
    std::vector<float> frames;
    std::vector<std::uint32_t> bases, columns, rows;
    frames.reserve(3 * table.faces.size());
    for (const FaceRec& face : table.faces) {
        frames.insert(frames.end(), {face.longest, face.apex_x, face.apex_y});
        bases.push_back(face.base);
        columns.push_back(face.columns);
        rows.push_back(face.rows);
    }
    arrays.push_back(real_numbers("face_frames", frames));
    arrays.push_back(whole_numbers("face_bases", bases));
    arrays.push_back(whole_numbers("face_columns", columns));
    arrays.push_back(whole_numbers("face_rows", rows));
}

/// Numbers that describe windows, in the order of the table.
struct Windows {
    std::vector<double> x, y, sigmas;
    std::vector<std::uint32_t> left, right, samples;

    explicit Windows(const WindowTable& table) {
        for (const FaceRec& face : table.faces) {
            const double size = 1 / static_cast<double>(face.cells_per_unit);
            for (std::uint32_t row = 0; row < face.rows; ++row) {
                for (std::uint32_t column = 0; column < face.columns; ++column) {
                    const std::uint32_t cell = face.first_cell + row * face.columns + column;
                    for (std::uint32_t i = table.starts[cell]; i < table.starts[cell + 1]; ++i) {
                        add(table.windows[i], column * size, row * size);
                    }
                }
            }
        }
    }

  private:
    void add(const WindowRec& window, double corner_x, double corner_y) {
        x.push_back(window.x - corner_x);
        y.push_back(window.y - corner_y);
        sigmas.push_back(window.sigma);
        left.push_back(angle_of(window.left_x, window.left_y));
        right.push_back(angle_of(window.right_x, window.right_y));
        samples.push_back(window.sample_index);
    }
};

double farthest(const std::vector<double>& numbers) {
    double most = 0;
    for (const double number : numbers) {
        most = std::max(most, std::abs(number));
    }
    return most;
}

} // namespace

DiskData disk_data(const WindowTable& table) {
    DiskData data;
    add_faces(table, data.arrays);
    std::vector<std::uint32_t> counts;
    counts.reserve(table.starts.size());
    for (std::size_t cell = 0; cell + 1 < table.starts.size(); ++cell) {
        counts.push_back(table.starts[cell + 1] - table.starts[cell]);
    }
    data.arrays.push_back(whole_numbers("cell_windows", counts));

    const Windows windows(table);
    // Minimum range, as numbers that are all alike have none.
    constexpr double kMinRange = 1e-6;
    const double reach = std::max({kMinRange, farthest(windows.x), farthest(windows.y)});
    const double longest = std::max(kMinRange, farthest(windows.sigmas));
    data.arrays.push_back(rounded_numbers("window_x", windows.x, -reach, reach));
    data.arrays.push_back(rounded_numbers("window_y", windows.y, -reach, reach));
    data.arrays.push_back(rounded_numbers("window_sigmas", windows.sigmas, 0, longest));
    data.arrays.push_back(whole_numbers("window_left", windows.left));
    data.arrays.push_back(whole_numbers("window_right", windows.right));
    data.arrays.push_back(whole_numbers("window_samples", windows.samples));

    const double turned = std::numbers::pi / kAngles * reach;
    data.scale = {table.unit, static_cast<double>(table.faces.front().cells_per_unit),
                  kFloatSeam + 2 * rounding_error(-reach, reach) + turned};
    return data;
}

} // namespace geodisk::tools::report
