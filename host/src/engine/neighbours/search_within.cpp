#include "engine/neighbours/search_within.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/domain/stages.hpp"
#include "engine/domain/surface_domain.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/neighbours/neighbour_lists.hpp"
#include "engine/neighbours/search_jobs.hpp"
#include "engine/run/first_parts.hpp"
#include "engine/run/run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// A division may turn out too coarse, up to so many times.
constexpr std::uint32_t kMostTries = 4;

class Search {
  public:
    Search(Runner::Impl& runner, const NeighbourQuery& query, const SearchJobs& jobs)
        : runner_(runner), query_(query), jobs_(jobs), sizes_(jobs.records_per_source()),
          lists_(query, jobs.frame().unit, runner.options.threads) {}
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;

    Task<Result<Neighbours>> go(WholeProgress whole);
    /// Returns true if it failed for what the device holds or does, not for what the query allows.
    bool lacks_room() const { return lacks_room_; }

  private:
    /// Finds those of up to so many sources. Returns false if there are more records than room.
    Task<Result<bool>> find(std::size_t sources, std::uint32_t room);
    /// Returns how far the search is, from the progress of the job at hand.
    Progress so_far(const Progress& now);

    Runner::Impl& runner_;
    const NeighbourQuery& query_;
    const SearchJobs& jobs_;
    PartSizes sizes_;
    NeighbourLists lists_;
    RunReport report_;
    std::size_t done_ = 0;   ///< Sources.
    std::uint32_t told_ = 0; ///< Maximum number of sources reported so far.
    bool lacks_room_ = false;
};

Progress Search::so_far(const Progress& now) {
    const auto all = static_cast<std::uint32_t>(query_.sources.size());
    const auto sources = static_cast<std::uint32_t>(done_) + now.disks;
    told_ = std::max(told_, std::min(sources, all)); // A job may begin again.
    const std::uint64_t pairs = lists_.pairs();
    return {told_, all, static_cast<std::uint32_t>(std::min<std::uint64_t>(pairs, ~0u)),
            report_.disks + now.disks, report_.windows + now.windows};
}

Task<Result<bool>> Search::find(std::size_t sources, std::uint32_t room) {
    const auto domain = jobs_.job(done_, sources, room);
    GEODISK_CO_TRY(domain);
    DiskRecords records;
    const auto recorded = co_await run_job(runner_, *domain, &records);
    GEODISK_CO_TRY(recorded);
    report_.add(recorded->report);
    report_.plan.trims |= recorded->report.plan.trims;
    sizes_.note(records.wanted, sources);
    if (records.wanted > records.hits.size()) {
        co_return false;
    }
    const auto& of = static_cast<const SurfaceDomain&>(Domain::Impl::of(*domain));
    const double start = runner_.now();
    lists_.add(sources, records.hits,
               jobs_.targets().empty() ? std::span<const std::uint32_t>() : of.target_numbers());
    report_.seconds.readback += runner_.now() - start;
    co_return true;
}

Task<Result<Neighbours>> Search::go(WholeProgress whole) {
    runner_.as_whole = [this, whole = std::move(whole)](const Progress& now) {
        return whole ? whole(so_far(now)) : so_far(now);
    };
    const double most =
        std::clamp(runner_.record_bytes() / sizeof(gpu::HitRec), kMinRecords, kMaxRecords);
    while (done_ < query_.sources.size()) {
        const std::size_t sources = sizes_.sources(most, done_, query_.sources.size() - done_);
        const auto found = co_await find(sources, sizes_.room(sources, most));
        lacks_room_ = !found;
        GEODISK_CO_TRY(found);
        if (*found) {
            done_ += sources;
            GEODISK_CO_TRY(check_pairs(query_, done_, lists_.pairs()));
        }
    }
    Neighbours neighbours = lists_.take();
    neighbours.error =
        ErrorModel(jobs_.frame()).error_of(report_.longest_chain, report_.plan.trims) *
        jobs_.frame().unit;
    neighbours.report = report_;
    co_return neighbours;
}

} // namespace

double shortest_distance(const PreparedMesh& mesh) {
    return 2 * mesh.statistics().longest_edge / kLongestEdge;
}

Task<Result<Neighbours>> search_undivided(Runner::Impl& runner, const PreparedMesh& mesh,
                                          const NeighbourQuery& query, const JobFrame* frame,
                                          WholeProgress whole, std::span<const double> bounds) {
    const auto jobs = SearchJobs::create(mesh, query, bounds, frame);
    GEODISK_CO_TRY(jobs);
    Search search(runner, query, *jobs);
    co_return co_await search.go(std::move(whole));
}

Task<Result<Neighbours>> search_within(Runner::Impl& runner, const PreparedMesh& mesh,
                                       const NeighbourQuery& query, WholeProgress whole,
                                       std::span<const double> bounds) {
    const auto jobs = SearchJobs::create(mesh, query, bounds);
    GEODISK_CO_TRY(jobs);
    Search search(runner, query, *jobs);
    auto found = co_await search.go(whole);
    if (found || !search.lacks_room() || !is_too_large(found.error())) {
        co_return found;
    }
    const auto domain = jobs->job(0, 1, static_cast<std::uint32_t>(kMinRecords));
    GEODISK_CO_TRY(domain);
    const std::uint32_t first =
        first_parts(runner, Domain::Impl::of(*domain), mesh, jobs->frame().min_distance);
    const std::uint32_t most = std::min(kMostTries * first, mesh.face_count());
    for (std::uint32_t parts = first; parts != 0 && parts <= most; parts *= 2) {
        auto searched = search_in_parts(runner, mesh, query, jobs->frame(), parts, whole, bounds);
        found = co_await searched;
        if (found || !is_too_large(found.error())) {
            break;
        }
    }
    co_return found;
}

} // namespace geodisk
