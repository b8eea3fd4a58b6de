#include "report/sample_data.hpp"

#include <algorithm>
#include <cstdint>

namespace geodisk::tools::report {

std::vector<PageArray> sample_arrays(const SampleDisks& samples,
                                     std::span<const analysis::Neighbor> neighbors) {
    const std::span<const SurfaceDisk> disks = samples.disks;
    std::vector<std::uint32_t> faces, nearest, kinds;
    std::vector<float> weights;
    std::vector<double> radii, distances;
    for (std::uint32_t i = 0; i < disks.size(); ++i) {
        const SurfaceDisk& sample = disks[i];
        faces.push_back(sample.face);
        weights.insert(weights.end(),
                       {static_cast<float>(sample.weight1), static_cast<float>(sample.weight2)});
        radii.push_back(sample.radius);
        kinds.push_back(sample.kind);
        const auto& [other, distance] = neighbors[i];
        const bool is_alone = other == analysis::Neighbor::kNone;
        nearest.push_back(is_alone ? i : other);
        distances.push_back(is_alone ? 0 : distance * samples.classes.of(sample, disks[other]));
    }
    if (!radii.empty() && std::all_of(radii.begin(), radii.end(),
                                      [&](double radius) { return radius == radii.front(); })) {
        radii.erase(radii.begin() + 1, radii.end());
    }
    kinds.resize(samples.classes.count > 0 ? kinds.size() : 1);
    return {whole_numbers("sample_faces", faces),
            real_numbers("sample_weights", weights),
            lengths("sample_radii", radii),
            whole_numbers("sample_kinds", kinds),
            whole_numbers("sample_neighbors", nearest),
            lengths("sample_distances", distances)};
}

} // namespace geodisk::tools::report
