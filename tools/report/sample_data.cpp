#include "report/sample_data.hpp"

#include <algorithm>
#include <cstdint>

namespace geodisk::tools::report {

std::vector<PageArray> sample_arrays(std::span<const SurfaceDisk> samples,
                                     std::span<const analysis::Neighbor> neighbors) {
    std::vector<std::uint32_t> faces, nearest;
    std::vector<float> weights, radii, distances;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        const SurfaceDisk& sample = samples[i];
        faces.push_back(sample.face);
        weights.insert(weights.end(),
                       {static_cast<float>(sample.weight1), static_cast<float>(sample.weight2)});
        radii.push_back(static_cast<float>(sample.radius));
        const auto& [other, distance] = neighbors[i];
        const bool is_alone = other == analysis::Neighbor::kNone;
        nearest.push_back(is_alone ? i : other);
        distances.push_back(
            is_alone ? 0 : static_cast<float>(distance * (sample.radius + samples[other].radius)));
    }
    if (!radii.empty() && std::all_of(radii.begin(), radii.end(),
                                      [&](float radius) { return radius == radii.front(); })) {
        radii.erase(radii.begin() + 1, radii.end());
    }
    return {whole_numbers("sample_faces", faces), real_numbers("sample_weights", weights),
            real_numbers("sample_radii", radii), whole_numbers("sample_neighbors", nearest),
            real_numbers("sample_distances", distances)};
}

} // namespace geodisk::tools::report
