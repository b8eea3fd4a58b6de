// The search on parts of a mesh, each with the faces of some sources and all that is near enough to
// them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/neighbours/search_jobs.hpp"
#include "engine/neighbours/search_within.hpp"
#include "parts/halo.hpp"
#include "parts/near_part.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// A query on a part, and what it refers to.
struct SearchPart {
    std::vector<std::uint32_t> numbers; ///< Of the sources, in the whole query.
    std::vector<std::uint32_t> targets; ///< Number of each vertex or point in the whole query.
    std::vector<Sample> sources, points;
    std::vector<double> radii, bounds;
    std::unique_ptr<PreparedMesh> mesh;
    NeighbourQuery query;
};

/// Makes the parts of a query.
class PartMaker {
  public:
    PartMaker(const PreparedMesh& mesh, const NeighbourQuery& query, const JobFrame& frame,
              std::span<const double> bounds, std::vector<std::uint32_t> owners)
        : mesh_(mesh), query_(query), frame_(frame), bounds_(bounds), owners_(std::move(owners)) {}

    /// A part without sources has no mesh.
    Result<std::unique_ptr<SearchPart>> part(std::uint32_t part) const;

  private:
    void take_sources(std::uint32_t owner, SearchPart& part) const;
    void take_vertices(std::span<const std::uint32_t> faces, SearchPart& part) const;
    /// Takes those of `points` that lie in the faces; `local` has the number of each face.
    void take_points(std::span<const Sample> points, const Ranks& local, SearchPart& part) const;

    const PreparedMesh& mesh_;
    const NeighbourQuery& query_;
    const JobFrame& frame_;
    std::span<const double> bounds_;
    std::vector<std::uint32_t> owners_;
};

void PartMaker::take_sources(std::uint32_t owner, SearchPart& part) const {
    for (std::uint32_t i = 0; i < query_.sources.size(); ++i) {
        if (owners_[query_.sources[i].face] == owner) {
            part.numbers.push_back(i);
            part.sources.push_back(query_.sources[i]);
            if (!query_.radii.empty()) {
                part.radii.push_back(query_.radii[i]);
            }
        }
    }
}

void PartMaker::take_vertices(std::span<const std::uint32_t> faces, SearchPart& part) const {
    for (const std::uint32_t face : faces) {
        for (const HalfEdge& edge : mesh_.half_edges().subspan(std::size_t{3} * face, 3)) {
            part.targets.push_back(edge.origin);
        }
    }
    std::ranges::sort(part.targets);
    part.targets.erase(std::unique(part.targets.begin(), part.targets.end()), part.targets.end());
    for (const std::uint32_t vertex : part.targets) {
        if (!bounds_.empty()) {
            part.bounds.push_back(bounds_[vertex]);
        }
    }
}

void PartMaker::take_points(std::span<const Sample> points, const Ranks& local,
                            SearchPart& part) const {
    part.targets.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::uint32_t face = local.of(points[i].face);
        if (face != Ranks::kNone) {
            part.targets.push_back(i);
            part.points.push_back(points[i]);
            part.points.back().face = face;
        }
    }
}

Result<std::unique_ptr<SearchPart>> PartMaker::part(std::uint32_t owner) const {
    auto made = std::make_unique<SearchPart>();
    take_sources(owner, *made);
    if (made->sources.empty()) {
        return made;
    }
    const double largest =
        query_.radii.empty() ? query_.within : *std::ranges::max_element(made->radii);
    auto near = near_part(mesh_, owners_, owner, largest * (1 + halo_margin(frame_)));
    GEODISK_TRY(near);
    made->mesh = std::move(near->mesh);
    for (Sample& source : made->sources) {
        source.face = near->local.of(source.face);
    }
    if (query_.kind == NeighbourKind::vertices || !bounds_.empty()) {
        take_vertices(near->faces, *made);
    }
    made->query = query_;
    if (query_.kind != NeighbourKind::vertices) {
        const bool among_sources = query_.kind == NeighbourKind::sources;
        take_points(among_sources ? query_.sources : query_.points, near->local, *made);
        made->query.kind = NeighbourKind::points; // Of all, a source itself too.
        made->query.points = made->points;
        made->query.nearest += among_sources && query_.nearest != 0 ? 1 : 0;
    }
    made->query.sources = made->sources;
    made->query.radii = made->radii;
    made->query.max_pairs = std::numeric_limits<std::uint64_t>::max(); // Of the whole is checked.
    return made;
}

/// The lists of all parts.
class PartLists {
  public:
    explicit PartLists(const NeighbourQuery& query) : query_(query) {}

    /// Takes what was found on a part.
    void add(SearchPart& part, Neighbours found);
    std::size_t sources() const { return sources_; }
    std::uint64_t pairs() const { return pairs_; }
    const RunReport& report() const { return report_; }
    /// Returns the lists in the order of the sources.
    Neighbours take();

  private:
    struct List {
        std::vector<std::uint32_t> numbers; ///< Of its sources.
        Neighbours found;
    };
    const NeighbourQuery& query_;
    std::vector<List> lists_;
    std::size_t sources_ = 0;
    std::uint64_t pairs_ = 0;
    double error_ = 0;
    RunReport report_;
};

void PartLists::add(SearchPart& part, Neighbours found) {
    const bool skips_own = query_.kind == NeighbourKind::sources;
    std::size_t kept = 0, begin = 0;
    for (std::size_t row = 0; row < part.numbers.size(); ++row) {
        const std::size_t end = found.offsets[row + 1], first = kept;
        for (std::size_t at = begin; at < end; ++at) {
            const std::uint32_t target = part.targets[found.indices[at]];
            const bool is_own = skips_own && target == part.numbers[row];
            const bool has_room = query_.nearest == 0 || kept - first < query_.nearest;
            if (!is_own && has_room) {
                found.indices[kept] = target;
                found.distances[kept++] = found.distances[at];
            }
        }
        begin = end;
        found.offsets[row + 1] = kept;
    }
    found.indices.resize(kept);
    found.distances.resize(kept);
    sources_ += part.numbers.size();
    pairs_ += kept;
    error_ = std::max(error_, found.error);
    report_.add(found.report);
    report_.plan.trims |= found.report.plan.trims;
    lists_.push_back({std::move(part.numbers), std::move(found)});
}

Neighbours PartLists::take() {
    Neighbours all;
    all.offsets.resize(query_.sources.size() + 1, 0);
    for (const List& list : lists_) {
        for (std::size_t row = 0; row < list.numbers.size(); ++row) {
            all.offsets[list.numbers[row] + 1] =
                list.found.offsets[row + 1] - list.found.offsets[row];
        }
    }
    for (std::size_t i = 1; i < all.offsets.size(); ++i) {
        all.offsets[i] += all.offsets[i - 1];
    }
    all.indices.resize(pairs_);
    all.distances.resize(pairs_);
    for (const auto& [numbers, found] : std::exchange(lists_, {})) {
        for (std::size_t row = 0; row < numbers.size(); ++row) {
            const std::size_t begin = found.offsets[row];
            const std::size_t count = found.offsets[row + 1] - begin;
            const std::size_t at = all.offsets[numbers[row]];
            std::ranges::copy(std::span(found.indices).subspan(begin, count),
                              std::span(all.indices).subspan(at, count).begin());
            std::ranges::copy(std::span(found.distances).subspan(begin, count),
                              std::span(all.distances).subspan(at, count).begin());
        }
    }
    all.error = error_;
    all.report = report_;
    return all;
}

} // namespace

Task<Result<Neighbours>> search_in_parts(Runner::Impl& runner, const PreparedMesh& mesh,
                                         const NeighbourQuery& query, const JobFrame& frame,
                                         std::uint32_t parts, WholeProgress whole,
                                         std::span<const double> bounds) {
    const PartMaker maker(mesh, query, frame, bounds, equal_parts(mesh, parts));
    PartLists lists(query);
    const WholeProgress so_far = [&](const Progress& now) {
        Progress all = now;
        all.decided += static_cast<std::uint32_t>(lists.sources());
        all.candidates = static_cast<std::uint32_t>(query.sources.size());
        const std::uint64_t pairs = lists.pairs() + now.accepted;
        all.accepted = static_cast<std::uint32_t>(std::min<std::uint64_t>(pairs, ~0u));
        all.disks += lists.report().disks;
        all.windows += lists.report().windows;
        return whole ? whole(all) : all;
    };
    for (std::uint32_t number = 0; number < parts; ++number) {
        const auto part = maker.part(number);
        GEODISK_CO_TRY(part);
        SearchPart& own = **part;
        if (own.sources.empty()) {
            continue;
        }
        auto searched = search_undivided(runner, *own.mesh, own.query, &frame, so_far, own.bounds);
        auto found = co_await searched;
        GEODISK_CO_TRY(found);
        lists.add(own, std::move(*found));
        GEODISK_CO_TRY(check_expected(query, static_cast<double>(lists.pairs())));
    }
    co_return lists.take();
}

} // namespace geodisk
