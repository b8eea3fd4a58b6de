#include "engine/update/dart_set.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "engine/domain/existing.hpp"
#include "engine/update/mesh_part.hpp"
#include "engine/update/update_checks.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

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

Error unknown(std::size_t index) {
    return invalid("sample " + std::to_string(index) +
                       " is no candidate of its face: the samples are of another mesh, seed, "
                       "minimum distance or pool ratio",
                   index);
}

} // namespace

Result<DartSet> DartSet::find(const MeshView& mesh, const SampleParams& params,
                              const JobFrame& frame, std::vector<NumberedSample> samples,
                              const ThreadOptions& threads) {
    std::ranges::sort(samples, {}, [](const NumberedSample& s) {
        return std::tuple_cat(order_of(s.sample), std::tuple(s.number));
    });
    DartSet set;
    Darts drawn;
    for (auto next = samples.cbegin(); next != samples.cend();) {
        std::vector<std::uint32_t> faces;
        auto end = next;
        for (; end != samples.cend(); ++end) {
            if (faces.empty() || faces.back() != end->sample.face) {
                if (faces.size() == kFacesAtOnce) {
                    break;
                }
                faces.push_back(end->sample.face);
            }
        }
        const auto part = MeshPart::prepare(mesh, params, std::move(faces), threads);
        GEODISK_TRY(part);
        const CandidateDraw draw(part->mesh(), part->params(), frame);
        for (std::uint32_t f = 0; f < part->faces().size(); ++f) {
            drawn.clear();
            for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
                draw.draw(f, stage, drawn);
            }
            const auto weights = [](const DrawnCandidate& c) { return by_weights(c.point); };
            std::ranges::sort(drawn, {}, weights);
            for (const std::uint32_t face = part->faces()[f];
                 next != end && next->sample.face == face; ++next) {
                const auto wanted = by_weights(to_point(next->sample));
                const auto found = std::ranges::lower_bound(drawn, wanted, {}, weights);
                if (found == drawn.end() || weights(*found) != wanted) {
                    return unknown(next->number);
                }
                if (next + 1 != end && order_of(next->sample) == order_of(next[1].sample)) {
                    return invalid("samples " + std::to_string(next->number) + " and " +
                                       std::to_string(next[1].number) + " are the same",
                                   next[1].number);
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
