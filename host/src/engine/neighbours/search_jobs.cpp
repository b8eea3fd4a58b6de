#include "engine/neighbours/search_jobs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/surface_domain.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/neighbours/check_query.hpp"
#include "mesh/edge_paths.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Paths that a disk finds to a target, and records of a source besides.
constexpr double kPathsPerTarget = 1.5;
constexpr double kMoreRecords = 16;
// Room for more records than expected.
constexpr double kSpareRecords = 1.25;
// Maximum of sources of a job.
constexpr double kMaxSources = 0x1p20;
// A disk has at most about this times the square of its radius, on most meshes.
constexpr double kDiskArea = 3.2;
// Sources whose pairs are counted before the search, at most.
constexpr std::size_t kCountedSources = 16;
// Sources after which the number of all pairs is estimated, at least.
constexpr std::size_t kFewSources = 64;

std::vector<ListedCandidate> targets_of(const NeighbourQuery& query) {
    const auto points = query.kind == NeighbourKind::points    ? query.points
                        : query.kind == NeighbourKind::sources ? query.sources
                                                               : std::span<const Sample>();
    std::vector<ListedCandidate> targets;
    targets.reserve(points.size());
    for (const Sample& point : points) {
        const auto [second, third] = rounded_weights(point.weights);
        targets.push_back({point.face, static_cast<std::uint32_t>(second * 0x1p24f),
                           static_cast<std::uint32_t>(third * 0x1p24f)});
    }
    return targets;
}

/// Returns no more targets than are within the distance of the source: those to which a path along
/// edges is short enough. Among sources it is one of them.
std::size_t count_along_edges(const PreparedMesh& mesh, const NeighbourQuery& query,
                              const Sample& source, double within) {
    EdgePaths paths(mesh, std::nextafter(within, HUGE_VAL));
    paths.begin_at(source, 0);
    const std::vector<double>& lengths = paths.lengths();
    if (query.kind == NeighbourKind::vertices) {
        return static_cast<std::size_t>(
            std::ranges::count_if(lengths, [&](double length) { return length <= within; }));
    }
    const auto points = query.kind == NeighbourKind::points ? query.points : query.sources;
    return static_cast<std::size_t>(std::ranges::count_if(points, [&](const Sample& point) {
        const std::array<double, 3> corners = corner_distances(mesh, point);
        const HalfEdge* const face = &mesh.half_edges()[std::size_t{3} * point.face];
        return lengths[face[0].origin] + corners[0] <= within ||
               lengths[face[1].origin] + corners[1] <= within ||
               lengths[face[2].origin] + corners[2] <= within;
    }));
}

} // namespace

Result<Done> check_expected(const NeighbourQuery& query, double pairs) {
    if (pairs <= static_cast<double>(query.max_pairs)) {
        return Done{};
    }
    return Error{Status::job_too_large,
                 "about " + number_text(std::round(pairs)) +
                     " pairs are to be expected, more than the " + std::to_string(query.max_pairs) +
                     " that are allowed; take a smaller distance or fewer sources"};
}

Result<Done> check_ahead(const PreparedMesh& mesh, const NeighbourQuery& query) {
    const std::size_t sources = query.sources.size();
    const std::size_t counted = std::min(sources, kCountedSources);
    const std::size_t own = query.kind == NeighbourKind::sources ? 1 : 0;
    double pairs = 0;
    for (std::size_t i = 0; i < counted; ++i) {
        const std::size_t at = i * sources / counted;
        const double within = query.radii.empty() ? query.within : query.radii[at];
        std::size_t found = count_along_edges(mesh, query, query.sources[at], within);
        found -= std::min(found, own);
        pairs += static_cast<double>(
            query.nearest == 0 ? found : std::min<std::size_t>(found, query.nearest));
    }
    const double of_all = pairs / static_cast<double>(counted) * static_cast<double>(sources);
    return check_expected(query, of_all);
}

Result<Done> check_edges(const PreparedMesh& mesh, double largest) {
    const double longest = mesh.statistics().longest_edge / largest;
    if (longest <= kLongestEdge) {
        return Done{};
    }
    return invalid("the distance is too small for this mesh: its longest edge is " +
                   number_text(longest) + " times as long, and single precision resolves at most " +
                   number_text(kLongestEdge) + " times; split long edges");
}

SearchJobs::SearchJobs(const PreparedMesh& mesh, const NeighbourQuery& query,
                       std::span<const double> bounds)
    : mesh_(&mesh), query_(&query), bounds_(bounds), targets_(targets_of(query)) {
    params_.min_distance =
        query.radii.empty() ? query.within : *std::ranges::max_element(query.radii);
}

Result<SearchJobs> SearchJobs::create(const PreparedMesh& mesh, const NeighbourQuery& query,
                                      std::span<const double> bounds, const JobFrame* whole) {
    SearchJobs jobs(mesh, query, bounds);
    SampleParams& params = jobs.params_;
    if (whole != nullptr) { // Which has been checked.
        params.min_distance = whole->min_distance;
        jobs.frame_ = *whole;
        return jobs;
    }
    GEODISK_TRY(check_edges(mesh, params.min_distance));
    const auto frame = frame_of_disks(mesh, params);
    GEODISK_TRY(frame);
    jobs.frame_ = *frame;
    GEODISK_TRY(check_range(frame->unit, frame->unit));
    if (jobs.targets_per_source() * static_cast<double>(query.sources.size()) >
        static_cast<double>(query.max_pairs)) {
        GEODISK_TRY(check_ahead(mesh, query));
    }
    return jobs;
}

double SearchJobs::targets_per_source() const {
    const auto all =
        static_cast<double>(targets_.empty() ? mesh_->vertex_count() : targets_.size());
    const double largest = params_.min_distance;
    return all * std::min(1.0, kDiskArea * largest * largest / mesh_->statistics().area);
}

double SearchJobs::records_per_source() const {
    return kPathsPerTarget * targets_per_source() + kMoreRecords;
}

Result<Domain> SearchJobs::job(std::size_t first, std::size_t sources, std::uint32_t room) const {
    SampleParams params = params_;
    std::vector<KeepOut> disks;
    if (query_->radii.empty()) {
        params.existing = query_->sources.subspan(first, sources);
    } else {
        disks.reserve(sources);
        for (std::size_t i = first; i < first + sources; ++i) {
            disks.push_back({query_->sources[i], query_->radii[i]});
        }
        params.avoid = disks;
    }
    return SurfaceDomain::recording(*mesh_, params, frame_, Ending::reach, targets_, room, bounds_);
}

std::size_t PartSizes::sources(double max_records, std::size_t done, std::size_t left) const {
    const auto most = static_cast<double>(left);
    // The first ones tell how many records a source has.
    const double at_once = done == 0 ? static_cast<double>(kFewSources) : kMaxSources;
    return static_cast<std::size_t>(
        std::clamp(std::min({max_records / (kSpareRecords * each_), most, at_once}), 1.0, most));
}

std::uint32_t PartSizes::room(std::size_t sources, double max_records) const {
    const double wanted = kSpareRecords * each_;
    return static_cast<std::uint32_t>(
        std::clamp(wanted * static_cast<double>(sources) + kMinRecords, kMinRecords,
                   std::max(max_records, wanted) + kMinRecords));
}

void PartSizes::note(double records, std::size_t sources) {
    each_ = std::max(each_, records / static_cast<double>(sources));
}

Result<Done> check_pairs(const NeighbourQuery& query, std::size_t done, std::uint64_t pairs) {
    const double expected = static_cast<double>(pairs) / static_cast<double>(done) *
                            static_cast<double>(query.sources.size());
    if (done < kFewSources && done < query.sources.size()) {
        return Done{};
    }
    return check_expected(query, expected);
}

} // namespace geodisk
