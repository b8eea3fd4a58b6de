#include "engine/neighbours/search_within.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/job_frame.hpp>

#include "engine/domain/given.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/surface_domain.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/neighbours/neighbour_lists.hpp"
#include "engine/run/run.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

// Paths that a disk finds to a target, and records of a source besides.
constexpr double kPathsPerTarget = 1.5;
constexpr double kMoreRecords = 16;
// Maximum of records read at once, and room for more than expected.
constexpr double kMostRecords = 0x1p22;
constexpr double kSpareRecords = 1.25;
constexpr double kLeastRecords = 4096;
// Maximum of sources of a job.
constexpr double kMostSources = 0x1p20;
// Sources after which the number of all pairs is estimated, at least.
constexpr std::size_t kFewSources = 64;

Result<Done> check_edges(const PreparedMesh& mesh, double largest) {
    const double longest = mesh.statistics().longest_edge / largest;
    if (longest <= kLongestEdge) {
        return Done{};
    }
    return invalid("the distance is too small for this mesh: its longest edge is " +
                   number_text(longest) + " times as long, and single precision resolves at most " +
                   number_text(kLongestEdge) + " times; split long edges");
}

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

class Search {
  public:
    Search(Runner::Impl& runner, const PreparedMesh& mesh, const NeighbourQuery& query,
           const SampleParams& params, const JobFrame& frame)
        : runner_(runner), mesh_(mesh), query_(query), params_(params), frame_(frame),
          targets_(targets_of(query)), lists_(query, frame.unit, runner.options.threads) {}
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;

    Task<Result<Neighbours>> go(WholeProgress whole);

  private:
    /// Returns the records to provide for a source at first.
    double first_guess() const;
    /// Finds those of up to so many sources. Returns false if there are more records than room.
    Task<Result<bool>> find(std::size_t sources, std::uint32_t room);
    Result<Done> check_pairs() const;
    /// Returns how far the search is, from the progress of the job at hand.
    Progress so_far(const Progress& now);

    Runner::Impl& runner_;
    const PreparedMesh& mesh_;
    const NeighbourQuery& query_;
    const SampleParams& params_;
    const JobFrame& frame_;
    std::vector<ListedCandidate> targets_;
    NeighbourLists lists_;
    RunReport report_;
    std::size_t done_ = 0;   ///< Sources.
    std::uint32_t told_ = 0; ///< Of them, at most.
    double records_per_source_ = 0;
};

double Search::first_guess() const {
    const auto all = static_cast<double>(targets_.empty() ? mesh_.vertex_count() : targets_.size());
    const double part = 3.2 * params_.min_distance * params_.min_distance / mesh_.statistics().area;
    return kPathsPerTarget * all * std::min(1.0, part) + kMoreRecords;
}

Progress Search::so_far(const Progress& now) {
    const auto all = static_cast<std::uint32_t>(query_.sources.size());
    const auto sources = static_cast<std::uint32_t>(done_) + now.disks;
    told_ = std::max(told_, std::min(sources, all)); // A job may begin again.
    const std::uint64_t pairs = lists_.pairs();
    return {told_, all, static_cast<std::uint32_t>(std::min<std::uint64_t>(pairs, ~0u)),
            report_.disks + now.disks, report_.windows + now.windows};
}

Task<Result<bool>> Search::find(std::size_t sources, std::uint32_t room) {
    SampleParams params = params_;
    std::vector<KeepOut> disks;
    if (query_.radii.empty()) {
        params.given = query_.sources.subspan(done_, sources);
    } else {
        disks.reserve(sources);
        for (std::size_t i = done_; i < done_ + sources; ++i) {
            disks.push_back({query_.sources[i], query_.radii[i]});
        }
        params.avoid = disks;
    }
    const auto domain =
        SurfaceDomain::recording(mesh_, params, frame_, Ending::reach, targets_, room);
    if (!domain) {
        co_return domain.error();
    }
    DiskRecords records;
    const auto recorded = co_await run_job(runner_, *domain, &records);
    if (!recorded) {
        co_return recorded.error();
    }
    report_.add(recorded->report);
    report_.plan.trims |= recorded->report.plan.trims;
    records_per_source_ =
        std::max(records_per_source_, records.wanted / static_cast<double>(sources));
    if (records.wanted > records.hits.size()) {
        co_return false;
    }
    const auto& of = static_cast<const SurfaceDomain&>(Domain::Impl::of(*domain));
    const double start = runner_.now();
    lists_.add(sources, records.hits,
               targets_.empty() ? std::span<const std::uint32_t>() : of.target_numbers());
    report_.seconds.readback += runner_.now() - start;
    co_return true;
}

Result<Done> Search::check_pairs() const {
    const auto pairs = static_cast<double>(lists_.pairs());
    const double expected =
        pairs / static_cast<double>(done_) * static_cast<double>(query_.sources.size());
    if (done_ < kFewSources && done_ < query_.sources.size()) {
        return Done{};
    }
    if (expected > static_cast<double>(query_.most_pairs)) {
        return Error{Status::job_too_large,
                     "about " + number_text(std::round(expected)) +
                         " pairs are to be expected, more than the " +
                         std::to_string(query_.most_pairs) +
                         " that are allowed; take a smaller distance or fewer sources"};
    }
    return Done{};
}

Task<Result<Neighbours>> Search::go(WholeProgress whole) {
    runner_.as_whole = [this, whole = std::move(whole)](const Progress& now) {
        return whole ? whole(so_far(now)) : so_far(now);
    };
    records_per_source_ = first_guess();
    const double most =
        std::clamp(runner_.record_bytes() / sizeof(gpu::HitRec), kLeastRecords, kMostRecords);
    while (done_ < query_.sources.size()) {
        const auto left = static_cast<double>(query_.sources.size() - done_);
        // The first ones tell how many records a source has.
        const double at_once = done_ == 0 ? static_cast<double>(kFewSources) : kMostSources;
        const double wanted = kSpareRecords * records_per_source_;
        const double sources = std::clamp(std::min({most / wanted, left, at_once}), 1.0, left);
        // One source takes what it needs.
        const double room = std::clamp(wanted * sources + kLeastRecords, kLeastRecords,
                                       std::max(most, wanted) + kLeastRecords);
        const auto found =
            co_await find(static_cast<std::size_t>(sources), static_cast<std::uint32_t>(room));
        if (!found) {
            co_return found.error();
        }
        if (*found) {
            done_ += static_cast<std::size_t>(sources);
            if (auto checked = check_pairs(); !checked) {
                co_return checked.error();
            }
        }
    }
    Neighbours neighbours = lists_.take();
    neighbours.error =
        ErrorModel(frame_).error_of(report_.longest_chain, report_.plan.trims) * frame_.unit;
    neighbours.report = report_;
    co_return neighbours;
}

} // namespace

double shortest_distance(const PreparedMesh& mesh) {
    return 2 * mesh.statistics().longest_edge / kLongestEdge;
}

Task<Result<Neighbours>> search_within(Runner::Impl& runner, const PreparedMesh& mesh,
                                       const NeighbourQuery& query, WholeProgress whole) {
    SampleParams params;
    params.min_distance =
        query.radii.empty() ? query.within : *std::ranges::max_element(query.radii);
    if (auto checked = check_edges(mesh, params.min_distance); !checked) {
        co_return checked.error();
    }
    params.throws = 1; // A pool might be too large, and none is drawn.
    const auto frame = frame_of(mesh, params);
    params.throws = 0;
    if (!frame) {
        co_return frame.error();
    }
    Search search(runner, mesh, query, params, *frame);
    co_return co_await search.go(std::move(whole));
}

} // namespace geodisk
