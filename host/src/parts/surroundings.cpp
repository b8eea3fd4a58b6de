#include "parts/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "parts/halo.hpp"

namespace geodisk {
namespace {

// In minimum distances. Hardly any chain of decisions is longer.
constexpr double kWidth = 4;
// How much farther disks of samples that are reached may lead, with the faces between.
constexpr double kBeyond = 3;

} // namespace

Surroundings::Surroundings(const Part& part, std::span<const std::uint32_t> faces,
                           std::span<const double> at_least)
    : part_(part), width_(kWidth * part.reach), searched_(width_ + kBeyond * part.reach),
      reach_(width_), distances_(part.mesh.vertex_count()) {
    HaloSearch halo(part.mesh);
    faces_ = halo.search(faces, searched_);
    for (std::uint32_t vertex = 0; vertex < distances_.size(); ++vertex) {
        distances_[vertex] =
            std::max(halo.distance(vertex), at_least.empty() ? 0 : at_least[vertex]);
    }
    std::erase_if(faces_, [&](std::uint32_t face) { return nearest(face) > searched_; });
    for (const std::uint32_t face : faces_) {
        if (nearest(face) <= width_) {
            reach_ = std::max(reach_, farthest(face));
        }
    }
    reach_ += part.reach;
}

double Surroundings::nearest(std::uint32_t face) const {
    const auto edges = part_.mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::min(
        {distances_[edges[0].origin], distances_[edges[1].origin], distances_[edges[2].origin]});
}

double Surroundings::farthest(std::uint32_t face) const {
    const auto edges = part_.mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::max(
        {distances_[edges[0].origin], distances_[edges[1].origin], distances_[edges[2].origin]});
}

double Surroundings::distance(const DrawnCandidate& dart) const {
    const std::uint32_t face = part_.local(dart.point.face);
    return part_.has(face, dart.point.face) ? nearest(face) : HUGE_VAL;
}

bool Surroundings::reaches_others(const DrawnCandidate& dart) const {
    return farthest(part_.local(dart.point.face)) > width_ - part_.reach;
}

std::vector<double> Surroundings::distances_on(const Part& around) const {
    std::vector<double> some(around.mesh.vertex_count());
    for (std::uint32_t h = 0; h < 3 * around.mesh.face_count(); ++h) {
        const std::uint32_t there = 3 * part_.local(around.faces[h / 3]) + h % 3;
        some[around.mesh.half_edges()[h].origin] =
            distances_[part_.mesh.half_edges()[there].origin];
    }
    return some;
}

Settled Surroundings::settled(const Settled& all, const Part& around) const {
    Settled some;
    for (std::size_t i = 0; i < all.samples.size(); ++i) {
        Sample sample = all.samples[i];
        if (nearest(sample.face) <= reach_) {
            sample.face = around.local(part_.faces[sample.face]);
            some.samples.push_back(sample);
            if (!all.classes.empty()) {
                some.classes.push_back(all.classes[i]);
            }
        }
    }
    return some;
}

} // namespace geodisk
