#include "geodisk/checks/intrusions.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr double kSmallestIntrusion = 1e-9; // Of a radius, for the rounding of doubles.
constexpr double kMaxCellsOfDisks = 0x1p26;
constexpr double kOutside = std::numeric_limits<double>::infinity();

} // namespace

std::vector<Intrusion> find_intrusions(const MeshInput& mesh, std::span<const SampleRow> rows,
                                       std::span<const std::uint32_t> existing,
                                       std::span<const std::uint32_t> classes,
                                       const Avoided& all_avoided, ProgressLine& progress) {
    const std::span<const KeepOut> avoided = all_avoided.disks;
    const std::span<const std::uint8_t> kept_out = all_avoided.classes;
    if (avoided.empty() || rows.empty()) {
        return {};
    }
    progress.begin_stage("verifying points to avoid");
    const double longest = 2 * ref::longest_path(mesh.sampled());
    const auto radius_of = [&](std::size_t point) {
        return std::min(avoided[point].radius, longest);
    };
    // Larger disks first: they may hold others.
    std::vector<std::size_t> order(avoided.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>{}, radius_of);

    std::vector<ref::FacePoint<double>> points;
    for (const SampleRow& row : rows) {
        const Sample at = mesh.sampled_of(row);
        points.push_back({at.face, at.weights[1], at.weights[2]});
    }
    for (const auto& [center, radius] : avoided) {
        points.push_back({center.face, center.weights[1], center.weights[2]});
    }
    const double unit =
        ref::suitable_unit(mesh.sampled(), radius_of(order.front()), kMaxCellsOfDisks);
    const ref::Surface<double> surface(mesh.sampled(), unit);
    const ref::Bins<double> bins(surface, points);
    ref::Detector<double> detector(surface, bins, ref::double_tolerances(), 1);
    detector.trim_all(); // The disks are large.
    detector.share_depths();

    std::vector<Intrusion> deepest(rows.size(), {0, 0, kOutside});
    const auto depth_of = [&](const Intrusion& one) { return radius_of(one.point) - one.distance; };
    std::vector<bool> is_held(avoided.size()); // Within a larger disk, so of no use.
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t point = order[i];
        if (is_held[point]) {
            continue;
        }
        check_interrupted();
        progress.update(static_cast<double>(i) / static_cast<double>(order.size()), "");
        const double radius = radius_of(point);
        const auto is_wanted = [&](std::uint32_t place) {
            const std::uint32_t row = bins.order[place];
            if (row >= rows.size()) {
                return true;
            }
            const bool is_kept_out = kept_out[point] == kAllClasses ||
                                     (!classes.empty() && classes[row] == kept_out[point]);
            return is_kept_out && (existing.empty() || existing[row] == 0);
        };
        const auto hit = [&](std::uint32_t place, double length) {
            const std::uint32_t row = bins.order[place];
            const double distance = length * unit;
            if (row >= rows.size()) {
                const std::size_t other = row - rows.size();
                const bool keeps_out_as_many =
                    kept_out[point] == kAllClasses || kept_out[point] == kept_out[other];
                is_held[other] = is_held[other] ||
                                 (keeps_out_as_many &&
                                  (radius == longest || radius - distance >= radius_of(other)));
            } else if (const Intrusion one{row, point, distance};
                       depth_of(one) > depth_of(deepest[row])) {
                deepest[row] = one;
            }
        };
        detector.set_limit(radius * (1 - kSmallestIntrusion) / unit);
        try {
            detector.run(points[rows.size() + point], is_wanted, hit);
        } catch (const ref::EndlessDisk& error) {
            throw UserError(ExitCode::bad_input, error.what());
        }
    }
    progress.clear();
    std::erase_if(deepest, [](const Intrusion& one) { return one.distance == kOutside; });
    return deepest;
}

} // namespace geodisk::tools
