#include "paper/metrics.hpp"

#include <algorithm>

#include "baselines/geodesic_disks.hpp"
#include "baselines/pool_darts.hpp"
#include "baselines/space_disks.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {

const char* name_of(Metric metric) {
    constexpr std::array<const char*, kMetrics.size()> kNames{"exact", "straight line",
                                                              "closed form"};
    return kNames[static_cast<std::size_t>(metric)];
}

std::vector<std::uint32_t> throw_darts(const PaperMesh& mesh, const Pool& pool, Metric metric) {
    tools::check_interrupted();
    const double distance = pool.params.min_distance;
    if (metric == Metric::exact) {
        ref::GeodesicDisks disks(mesh.prepared, distance, pool.by_rank, pool.tolerances);
        return ref::throw_in_order(disks);
    }
    const auto points = ref::oriented_points(mesh.view(), pool.by_rank);
    ref::SpaceDisks disks(points, distance,
                          metric == Metric::straight ? ref::straight_length : ref::curve_length);
    return ref::throw_in_order(disks);
}

Violations find_violations(const PaperMesh& mesh,
                           const std::vector<ref::FacePoint<double>>& samples,
                           double min_distance) {
    constexpr double kRounding = 1e-9;
    ref::GeodesicDisks disks(mesh.prepared, min_distance * (1 - kRounding), samples,
                             ref::double_tolerances());
    const std::vector<std::uint8_t> all(samples.size(), 1);
    std::vector<std::uint8_t> is_close(samples.size(), 0);
    std::vector<std::uint32_t> disk;
    Violations violations;
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        tools::check_interrupted();
        disks.find(sample, all, disk);
        for (const std::uint32_t other : disk) {
            violations.pairs += sample < other ? 1u : 0u; // Found from the other one as well.
            is_close[sample] = is_close[other] = 1;
        }
    }
    violations.samples =
        static_cast<std::size_t>(std::count(is_close.begin(), is_close.end(), std::uint8_t{1}));
    return violations;
}

} // namespace geodisk::paper
