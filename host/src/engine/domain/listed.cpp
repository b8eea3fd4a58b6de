#include "engine/domain/listed.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>

#include <geodisk/job_frame.hpp>

#include "constants.h"
#include "engine/capacity.hpp"
#include "engine/domain/check_frame.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/surface_domain.hpp"
#include "records.h"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kMaxListed = std::size_t{1} << gpu::kPriorityBits;

Result<Done> check_listed(const PreparedMesh& mesh, const SampleParams& params,
                          std::span<const ListedCandidate> candidates,
                          std::span<const std::uint8_t> classes) {
    const bool has_classes = !params.class_factors.empty();
    const std::size_t most = has_classes ? kMaxListed / gpu::kMaxClasses : kMaxListed;
    if (candidates.empty() || candidates.size() > most) {
        return invalid(std::string("a list of candidates has 1 to 2^") +
                       (has_classes ? "25" : "28") + ", not " + std::to_string(candidates.size()));
    }
    if (params.darts != 0) {
        return invalid("candidates are listed, so there are no darts to throw");
    }
    if (classes.size() != (has_classes ? candidates.size() : 0)) {
        return invalid(has_classes ? "listed candidates have no classes"
                                   : "listed candidates have classes, and there is no table");
    }
    if (params.maximal) {
        return invalid("listed candidates make no maximal set");
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto [face, weight1, weight2] = candidates[i];
        if (face >= mesh.face_count()) {
            return invalid("listed candidate " + std::to_string(i) + " is in face " +
                           std::to_string(face) + ", but there are " +
                           std::to_string(mesh.face_count()));
        }
        if (weight1 > kOneWeight || weight2 > kOneWeight - weight1) {
            return invalid("listed candidate " + std::to_string(i) +
                           " has weights that sum to more than 1");
        }
    }
    return Done{};
}

/// Returns the numbers of the candidates in the order of their faces, and adds the first of each
/// face to `starts`, and the end.
std::vector<std::uint32_t> sorted_by_face(std::uint32_t faces,
                                          std::span<const ListedCandidate> candidates,
                                          std::vector<std::uint32_t>& starts) {
    starts.assign(std::size_t{faces} + 1, 0);
    for (const ListedCandidate& candidate : candidates) {
        ++starts[candidate.face + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    std::vector<std::uint32_t> sorted(candidates.size());
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        sorted[next[candidates[i].face]++] = i;
    }
    return sorted;
}

/// Sorts the candidates of each face by their cells, and returns the table of cells.
std::vector<std::uint32_t> sort_by_cell(const PlacedSurface& surface, const FaceCells& cells,
                                        std::span<const ListedCandidate> candidates,
                                        std::span<const std::uint32_t> starts,
                                        std::span<std::uint32_t> sorted) {
    if (cells.count == 0) {
        return {};
    }
    std::vector<std::uint32_t> table(std::size_t{cells.count} + 2, 0);
    std::vector<std::uint32_t> cell_of(candidates.size());
    for_face_grids(surface, [&](std::uint32_t face, const FaceGrid& grid) {
        const auto own = sorted.subspan(starts[face], starts[face + 1] - starts[face]);
        for (const std::uint32_t i : own) {
            const auto [in, weight1, weight2] = candidates[i];
            cell_of[i] = grid.cell_of(*surface.mesh, in, weight1 * 0x1p-24, weight2 * 0x1p-24);
            ++table[cell_of[i] + 1];
        }
        std::ranges::stable_sort(own, {}, [&](std::uint32_t i) { return cell_of[i]; });
    });
    std::partial_sum(table.begin(), table.end(), table.begin());
    return table;
}

} // namespace

Stages listed_stages(double samples, std::size_t candidates, CandidateSource source) {
    Stages stages{samples, static_cast<double>(candidates) / samples, 0, source};
    stages.max_stages = 1;
    stages.max_expected = static_cast<double>(candidates);
    return stages;
}

ListedBuffers listed_buffers(const PlacedSurface& surface, const FaceCells& cells,
                             std::span<const ListedCandidate> candidates,
                             std::span<const std::uint8_t> classes) {
    ListedBuffers buffers;
    std::vector<std::uint32_t>& sorted = buffers.numbers;
    sorted = sorted_by_face(surface.mesh->face_count(), candidates, buffers.starts);
    buffers.cells = sort_by_cell(surface, cells, candidates, buffers.starts, sorted);
    const std::uint32_t capacity = capacity_for(surface.stages, 1);
    const auto count = static_cast<std::uint32_t>(candidates.size());
    // Batches are chosen as if orders were spread evenly.
    const std::uint32_t step = (1u << gpu::kPriorityBits) / count;
    const std::uint32_t places = classes.empty() ? ~0u : ~gpu::kClassMask;
    buffers.weights.resize(2 * candidates.size());
    buffers.orders.resize(capacity + state_words(capacity), 0);
    for (std::uint32_t place = 0; place < count; ++place) {
        const ListedCandidate& candidate = candidates[sorted[place]];
        const std::uint32_t number = classes.empty() ? 0 : classes[sorted[place]];
        buffers.weights[2 * std::size_t{place}] = candidate.weight1 | number << gpu::kClassShift;
        buffers.weights[2 * std::size_t{place} + 1] = candidate.weight2;
        buffers.orders[place] = sorted[place] * (step & places) | number;
        buffers.orders[capacity + (place >> 5 << 1)] |= 1u << (place & 31); // Undecided.
    }
    return buffers;
}

Result<Domain> SurfaceDomain::listed(const PreparedMesh& mesh, const SampleParams& params,
                                     const JobFrame& frame,
                                     std::span<const ListedCandidate> candidates, bool may_divide,
                                     std::span<const std::uint8_t> classes) {
    PlacedSurface surface = placed(mesh, params, frame);
    surface.may_divide = may_divide;
    surface.stages =
        listed_stages(surface.stages.samples, candidates.size(), CandidateSource::list);
    auto cells = count_cells({&surface, 1});
    GEODISK_TRY(cells);
    auto made = std::make_unique<SurfaceDomain>(std::vector{surface}, std::move(*cells));
    made->listed_ = listed_buffers(surface, made->cells_, candidates, classes);
    const double most = static_cast<double>(made->settled.size() + candidates.size());
    made->samples = std::min(made->samples, most);
    if (made->whole) {
        made->whole->list.assign(candidates.begin(), candidates.end());
    }
    return Domain::Impl::wrap(std::move(made));
}

Result<Domain> SurfaceDomain::recording(const PreparedMesh& mesh, const SampleParams& params,
                                        const JobFrame& frame, Ending ending,
                                        std::span<const ListedCandidate> targets,
                                        std::uint32_t max_records, std::span<const double> bounds) {
    // A job needs a candidate, also without targets.
    const ListedCandidate candidate{0, 0, 0};
    const auto candidates = targets.empty() ? std::span(&candidate, 1) : targets;
    PlacedSurface surface = placed(mesh, params, frame);
    surface.stages =
        listed_stages(surface.stages.samples, candidates.size(), CandidateSource::targets);
    auto cells = targets.empty() ? FaceCells{} : count_cells({&surface, 1});
    GEODISK_TRY(cells);
    auto made = std::make_unique<SurfaceDomain>(std::vector{surface}, std::move(*cells));
    made->listed_ = listed_buffers(surface, made->cells_, candidates);
    made->kernels.ending = ending;
    made->kernels.points = !targets.empty();
    // A head, the weights of the targets, two to a row, then the records.
    std::vector<std::uint32_t>& words = made->listed_.weights;
    words.resize(targets.empty() ? 0 : (words.size() + 3) / 4 * 4, 0);
    const auto first = static_cast<std::uint32_t>(1 + words.size() / 4);
    words.insert(words.begin(), {0, max_records, first, 0});
    const std::size_t bytes = ending == Ending::light ? sizeof(gpu::LitRec) : sizeof(gpu::HitRec);
    made->record_bytes_ = words.size() * sizeof words[0] + std::uint64_t{max_records} * bytes;
    made->samples = std::max<double>(1, static_cast<double>(made->settled.size()));
    if (!bounds.empty()) {
        made->set_bounds(bounds);
    }
    return Domain::Impl::wrap(std::move(made));
}

Result<Domain> listed_domain(const PreparedMesh& mesh, const SampleParams& params,
                             std::span<const ListedCandidate> candidates) noexcept {
    return guarded([&]() -> Result<Domain> {
        const auto frame = frame_of_disks(mesh, params); // A list may be far shorter than a pool.
        GEODISK_TRY(frame);
        GEODISK_TRY(check_listed(mesh, params, candidates, {}));
        return SurfaceDomain::listed(mesh, params, *frame, candidates, true);
    });
}

Result<Domain> listed_domain(const PreparedMesh& mesh, const SampleParams& params,
                             const JobFrame& frame, std::span<const ListedCandidate> candidates,
                             std::span<const std::uint8_t> classes) noexcept {
    return guarded([&]() -> Result<Domain> {
        GEODISK_TRY(check_params(mesh, params));
        GEODISK_TRY(check_frame(frame, mesh, params));
        GEODISK_TRY(check_listed(mesh, params, candidates, classes));
        return SurfaceDomain::listed(mesh, params, frame, candidates, false, classes);
    });
}

Sample to_sample(const ListedCandidate& candidate) {
    const float second = static_cast<float>(candidate.weight1) * 0x1p-24f;
    const float third = static_cast<float>(candidate.weight2) * 0x1p-24f;
    return {candidate.face, {1 - second - third, second, third}};
}

Result<std::vector<std::size_t>> places_of(std::span<const Sample> samples,
                                           std::span<const ListedCandidate> list) {
    std::vector<std::size_t> places;
    places.reserve(samples.size());
    std::size_t next = 0;
    for (const Sample& sample : samples) {
        const auto is_it = [&](const ListedCandidate& candidate) {
            const Sample own = to_sample(candidate);
            return own.face == sample.face && own.weights[1] == sample.weights[1] &&
                   own.weights[2] == sample.weights[2];
        };
        while (next < list.size() && !is_it(list[next])) {
            ++next;
        }
        if (next == list.size()) {
            return Error{Status::internal, "a sample is none of the listed candidates"};
        }
        places.push_back(next++);
    }
    return places;
}

} // namespace geodisk
