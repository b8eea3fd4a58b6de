#include "baselines/geodesic_disks.hpp"

namespace geodisk::ref {

GeodesicDisks::GeodesicDisks(const PreparedMesh& mesh, double min_distance,
                             std::span<const FacePoint<double>> by_rank,
                             const Tolerances& tolerances)
    : surface_(mesh, min_distance), bins_(surface_, by_rank),
      detector_(surface_, bins_, tolerances, tolerances.limit), places_(by_rank.size()),
      found_in_(by_rank.size(), 0) {
    for (std::uint32_t place = 0; place < bins_.order.size(); ++place) {
        places_[bins_.order[place]] = place;
    }
}

void GeodesicDisks::find(std::uint32_t center, std::span<const std::uint8_t> wanted,
                         std::vector<std::uint32_t>& found) {
    found.clear();
    // Several paths may lead to one candidate.
    ++disk_;
    found_in_[center] = disk_;
    detector_.run(
        bins_.points[places_[center]],
        [&](std::uint32_t place) {
            const std::uint32_t rank = bins_.order[place];
            return wanted[rank] != 0 && found_in_[rank] != disk_;
        },
        [&](std::uint32_t place, double) {
            found_in_[bins_.order[place]] = disk_;
            found.push_back(bins_.order[place]);
        });
}

} // namespace geodisk::ref
