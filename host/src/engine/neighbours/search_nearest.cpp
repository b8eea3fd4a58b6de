#include "engine/neighbours/search_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "engine/neighbours/search_jobs.hpp"
#include "engine/neighbours/search_within.hpp"
#include "mesh/components.hpp"
#include "mesh/extent.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// The first disks are so much larger than those that hold as many targets as wanted on average.
constexpr double kFirst = 1.3;
constexpr double kFactor = 2;

class NearestSearch {
  public:
    NearestSearch(Runner::Impl& runner, const PreparedMesh& mesh, const NeighbourQuery& query)
        : runner_(runner), mesh_(mesh), query_(query), shortest_(shortest_distance(mesh)),
          bound_(distance_bound(mesh)) {}
    NearestSearch(const NearestSearch&) = delete;
    NearestSearch& operator=(const NearestSearch&) = delete;

    Task<Result<Neighbours>> go();

  private:
    /// Tells how many neighbours each source can have, at most as many as wanted.
    void count_wanted();
    /// Checks that the query allows the pairs to expect.
    Result<Done> check_pairs_wanted() const;
    double first_distance() const;
    /// Returns the distance that the query allows a source.
    double limit(std::uint32_t source) const;
    /// Returns true if a disk of this radius has all neighbours that a source may have.
    bool is_whole(std::uint32_t source, double within) const {
        return within >= limit(source) || within > bound_;
    }
    /// Searches at this distance, or up to the limit, for those that lack neighbours.
    Task<Result<Done>> search(double within);
    void keep(const Neighbours& found, double within);
    Neighbours all() const;
    /// Returns how far the search is, from the progress of that at one distance.
    Progress so_far(const Progress& now);

    Runner::Impl& runner_;
    const PreparedMesh& mesh_;
    const NeighbourQuery& query_;
    double shortest_;                    ///< Disks are no smaller.
    double bound_;                       ///< No path is longer.
    std::vector<std::uint32_t> wanted_;  ///< Neighbours of each source.
    std::vector<std::uint32_t> pending_; ///< Sources that lack some.
    std::vector<Sample> points_;         ///< Those of the search in work.
    std::vector<double> radii_;          ///< Their distances, if the query has one for each.
    std::vector<std::vector<std::uint32_t>> indices_;
    std::vector<std::vector<float>> distances_;
    std::uint64_t targets_ = 0;
    std::uint64_t pairs_ = 0; ///< Of the sources that have theirs.
    std::uint32_t told_ = 0;
    double error_ = 0;
    RunReport report_;
};

void NearestSearch::count_wanted() {
    Components components(mesh_);
    std::vector<std::uint32_t> targets(mesh_.vertex_count(), 0); // By component.
    const bool among_sources = query_.kind == NeighbourKind::sources;
    if (query_.kind == NeighbourKind::vertices) {
        for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            targets[components.of_vertex(v)] += mesh_.fans()[v].corner_count > 0;
        }
    } else {
        for (const Sample& point : among_sources ? query_.sources : query_.points) {
            ++targets[components.of(point)];
        }
    }
    for (const std::uint32_t count : targets) {
        targets_ += count;
    }
    wanted_.reserve(query_.sources.size());
    for (std::uint32_t i = 0; i < query_.sources.size(); ++i) {
        const std::uint32_t there = targets[components.of(query_.sources[i])];
        wanted_.push_back(std::min(query_.nearest, there - (among_sources ? 1 : 0)));
        if (wanted_.back() > 0) {
            pending_.push_back(i);
        }
    }
}

Result<Done> NearestSearch::check_pairs_wanted() const {
    const double wanted = std::accumulate(wanted_.begin(), wanted_.end(), 0.0);
    const bool may_be_fewer =
        query_.has_distances() && wanted > static_cast<double>(query_.max_pairs);
    return may_be_fewer ? check_ahead(mesh_, query_) : check_expected(query_, wanted);
}

double NearestSearch::first_distance() const {
    const double each = mesh_.statistics().area / static_cast<double>(targets_);
    const double wanted = std::min<double>(query_.nearest, static_cast<double>(targets_));
    const double needed = std::sqrt(each * wanted / std::numbers::pi);
    return std::max(kFirst * needed, shortest_);
}

Progress NearestSearch::so_far(const Progress& now) {
    const auto all = static_cast<std::uint32_t>(query_.sources.size());
    const std::uint32_t done = all - static_cast<std::uint32_t>(pending_.size()) + now.decided;
    told_ = std::max(told_, std::min(done, all));
    return {told_, all, now.accepted, report_.disks + now.disks, report_.windows + now.windows};
}

double NearestSearch::limit(std::uint32_t source) const {
    if (!query_.radii.empty()) {
        return query_.radii[source];
    }
    return query_.has_distances() ? query_.within : std::numeric_limits<double>::infinity();
}

Task<Result<Done>> NearestSearch::search(double within) {
    points_.clear();
    radii_.clear();
    double largest = 0;
    for (const std::uint32_t source : pending_) {
        points_.push_back(query_.sources[source]);
        radii_.push_back(std::max(std::min(within, limit(source)), shortest_));
        largest = std::max(largest, radii_.back());
    }
    NeighbourQuery query = query_;
    query.sources = points_;
    query.within = largest;
    query.radii = query_.radii.empty() ? std::span<const double>() : radii_;
    query.max_pairs = std::numeric_limits<std::uint64_t>::max(); // go() checks them.
    if (query_.kind == NeighbourKind::sources) {
        query.kind = NeighbourKind::points; // Of all, with itself.
        query.points = query_.sources;
        ++query.nearest;
    }
    const auto searched =
        search_within(runner_, mesh_, query, [this](const Progress& now) { return so_far(now); });
    const auto found = co_await searched;
    GEODISK_CO_TRY(found);
    report_.add(found->report);
    error_ = std::max(error_, found->error);
    keep(*found, within);
    co_return check_expected(query_, static_cast<double>(pairs_));
}

void NearestSearch::keep(const Neighbours& found, double within) {
    std::vector<std::uint32_t> lacking;
    for (std::size_t row = 0; row < pending_.size(); ++row) {
        const std::uint32_t source = pending_[row];
        std::vector<std::uint32_t> indices;
        std::vector<float> distances;
        for (std::size_t at = found.offsets[row]; at < found.offsets[row + 1]; ++at) {
            const bool is_own =
                query_.kind == NeighbourKind::sources && found.indices[at] == source;
            // A disk may be larger than the query allows, where that is short for the mesh.
            const bool is_near = limit(source) >= shortest_ || found.distances[at] <= limit(source);
            if (!is_own && is_near && indices.size() < wanted_[source]) {
                indices.push_back(found.indices[at]);
                distances.push_back(found.distances[at]);
            }
        }
        if (indices.size() < wanted_[source] && !is_whole(source, within)) {
            lacking.push_back(source);
            continue;
        }
        pairs_ += indices.size();
        indices_[source] = std::move(indices);
        distances_[source] = std::move(distances);
    }
    pending_ = std::move(lacking);
}

Neighbours NearestSearch::all() const {
    Neighbours all;
    all.offsets.push_back(0);
    for (std::size_t source = 0; source < indices_.size(); ++source) {
        all.indices.insert(all.indices.end(), indices_[source].begin(), indices_[source].end());
        all.distances.insert(all.distances.end(), distances_[source].begin(),
                             distances_[source].end());
        all.offsets.push_back(all.indices.size());
    }
    all.error = error_;
    all.report = report_;
    return all;
}

Task<Result<Neighbours>> NearestSearch::go() {
    count_wanted();
    GEODISK_CO_TRY(check_pairs_wanted());
    indices_.resize(query_.sources.size());
    distances_.resize(query_.sources.size());
    for (double within = first_distance(); !pending_.empty(); within *= kFactor) {
        GEODISK_CO_TRY(co_await search(within));
    }
    co_return all();
}

} // namespace

Task<Result<Neighbours>> search_nearest(Runner::Impl& runner, const PreparedMesh& mesh,
                                        const NeighbourQuery& query) {
    NearestSearch search(runner, mesh, query);
    co_return co_await search.go();
}

} // namespace geodisk
