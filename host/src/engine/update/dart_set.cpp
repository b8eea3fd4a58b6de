#include "engine/update/dart_set.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "engine/domain/given.hpp"
#include "engine/update/mesh_part.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

// Faces whose candidates are drawn at a time.
constexpr std::size_t kFacesAtOnce = std::size_t{1} << 16;

ListedCandidate to_point(const Sample& sample) {
    const auto [second, third] = rounded_weights(sample.weights);
    return {sample.face, static_cast<std::uint32_t>(second * 0x1p24f),
            static_cast<std::uint32_t>(third * 0x1p24f)};
}

auto by_weights(const ListedCandidate& point) {
    return std::tuple(point.weight1, point.weight2);
}

/// Samples of a face, by their index, with the point of each.
struct Wanted {
    ListedCandidate point;
    std::size_t index;
};

Error unknown(std::size_t index) {
    return invalid("sample " + std::to_string(index) +
                       " is no candidate of its face: the samples are of another mesh, seed, "
                       "minimum distance or pool ratio",
                   index);
}

} // namespace

Result<DartSet> DartSet::find(const MeshView& mesh, const SampleParams& params,
                              const JobFrame& frame, std::span<const Sample> samples,
                              std::size_t first_index, const ThreadOptions& threads) {
    std::vector<Wanted> wanted;
    wanted.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t index = first_index + i;
        if (samples[i].face >= mesh.face_count()) {
            return invalid("sample " + std::to_string(index) + " is in face " +
                               std::to_string(samples[i].face) + ", but there are " +
                               std::to_string(mesh.face_count()),
                           index);
        }
        wanted.push_back({to_point(samples[i]), index});
    }
    std::ranges::sort(wanted, {}, [](const Wanted& w) {
        return std::tuple(w.point.face, w.point.weight1, w.point.weight2);
    });
    DartSet set;
    Darts drawn;
    for (auto next = wanted.begin(); next != wanted.end();) {
        std::vector<std::uint32_t> faces;
        auto end = next;
        for (; end != wanted.end(); ++end) {
            if (faces.empty() || faces.back() != end->point.face) {
                if (faces.size() == kFacesAtOnce) {
                    break;
                }
                faces.push_back(end->point.face);
            }
        }
        const auto part = MeshPart::prepare(mesh, params, std::move(faces), threads);
        if (!part) {
            return part.error();
        }
        const CandidateDraw draw(part->mesh(), part->params(), frame);
        for (std::uint32_t f = 0; f < part->faces().size(); ++f) {
            drawn.clear();
            for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
                draw.draw(f, stage, drawn);
            }
            const auto weights = [](const DrawnCandidate& c) { return by_weights(c.point); };
            std::ranges::sort(drawn, {}, weights);
            for (const std::uint32_t face = part->faces()[f];
                 next != end && next->point.face == face; ++next) {
                const auto found =
                    std::ranges::lower_bound(drawn, by_weights(next->point), {}, weights);
                if (found == drawn.end() || weights(*found) != by_weights(next->point)) {
                    return unknown(next->index);
                }
                if (next + 1 != end && next->point == next[1].point) {
                    return invalid("samples " + std::to_string(next->index) + " and " +
                                       std::to_string(next[1].index) + " are the same",
                                   next[1].index);
                }
                set.in_order_.push_back(*found);
                set.in_order_.back().point.face = face;
            }
        }
    }
    std::ranges::sort(set.in_order_, DartOrder{!params.face_keys.empty()});
    for (const DrawnCandidate& dart : set.in_order_) {
        set.on_face_[dart.point.face].push_back(dart);
    }
    return set;
}

std::span<const DrawnCandidate> DartSet::on_face(std::uint32_t face) const {
    const auto found = on_face_.find(face);
    return found == on_face_.end() ? std::span<const DrawnCandidate>() : found->second;
}

void DartSet::replace(const Darts& removed, const Darts& added, bool has_keys) {
    const DartOrder before{has_keys};
    Darts kept, all;
    kept.reserve(in_order_.size());
    all.reserve(in_order_.size() + added.size());
    std::ranges::set_difference(in_order_, removed, std::back_inserter(kept), before);
    std::ranges::merge(kept, added, std::back_inserter(all), before);
    in_order_ = std::move(all);
    for (const DrawnCandidate& dart : removed) {
        std::erase(on_face_[dart.point.face], dart);
    }
    for (const DrawnCandidate& dart : added) {
        on_face_[dart.point.face].push_back(dart);
    }
}

} // namespace geodisk
