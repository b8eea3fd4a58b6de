#include "geodisk/checks/intrusions.hpp"

#include <algorithm>
#include <limits>

#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr double kSmallestIntrusion = 1e-9; // Of a radius, for the rounding of doubles.
constexpr double kMostCells = 0x1p26;

} // namespace

std::vector<Intrusion> find_intrusions(const MeshInput& mesh, std::span<const SampleRow> rows,
                                       std::span<const std::uint32_t> given,
                                       std::span<const KeepOut> avoided, ProgressLine& progress) {
    std::vector<Intrusion> found;
    if (avoided.empty() || rows.empty()) {
        return found;
    }
    progress.begin_stage("verifying points to avoid");
    std::vector<ref::FacePoint<double>> points;
    for (const SampleRow& row : rows) {
        points.push_back({row.face, row.bary[1], row.bary[2]});
    }
    const double longest = 2 * ref::longest_path(mesh.prepared);
    const double largest =
        std::min(std::ranges::max(avoided, {}, &KeepOut::radius).radius, longest);
    const double unit = ref::suitable_unit(mesh.prepared, largest, kMostCells);
    const ref::Surface<double> surface(mesh.prepared, unit);
    const ref::Bins<double> bins(surface, points);
    ref::Detector<double> detector(surface, bins, ref::double_tolerances(), 1);
    std::vector<double> distances(rows.size());
    for (std::size_t i = 0; i < avoided.size(); ++i) {
        check_interrupted();
        progress.update(static_cast<double>(i) / static_cast<double>(avoided.size()), "");
        const auto& [center, radius] = avoided[i];
        detector.set_limit(std::min(radius * (1 - kSmallestIntrusion), longest) / unit);
        std::ranges::fill(distances, std::numeric_limits<double>::infinity());
        const auto is_new = [&](std::uint32_t place) {
            return given.empty() || given[bins.order[place]] == 0;
        };
        const auto hit = [&](std::uint32_t place, double distance) {
            double& least = distances[bins.order[place]];
            least = std::min(least, distance * unit);
        };
        try {
            detector.run({center.face, center.weights[1], center.weights[2]}, is_new, hit);
        } catch (const ref::EndlessDisk& error) {
            throw UserError(ExitCode::bad_input, error.what());
        }
        for (std::uint32_t row = 0; row < rows.size(); ++row) {
            if (distances[row] < std::numeric_limits<double>::infinity()) {
                found.push_back({row, i, distances[row]});
            }
        }
    }
    progress.clear();
    return found;
}

} // namespace geodisk::tools
