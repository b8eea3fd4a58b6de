#include "kernels/pool.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "constants.h"
#include "kernels/candidates.hpp"
#include "kernels/dart_order.hpp"

namespace geodisk::ref {
namespace {

/// Number of candidates of each face, by stage.
using Counts = std::vector<std::vector<std::uint32_t>>;

std::vector<std::size_t> stage_starts(const Counts& counts) {
    std::vector<std::size_t> starts{0};
    for (const std::vector<std::uint32_t>& stage : counts) {
        starts.push_back(std::accumulate(stage.begin(), stage.end(), starts.back()));
    }
    return starts;
}

/// Draws the candidates of stages face by face into a pool.
template <class Real>
class Drawing {
  public:
    Drawing(const Surface<Real>& surface, const SampleParams& params, std::uint32_t first_stage,
            const Counts& counts)
        : surface_(surface), params_(params), first_stage_(first_stage), counts_(counts),
          starts_(stage_starts(counts)), next_(starts_.begin(), starts_.end() - 1),
          darts_(starts_.back()) {}

    Pool<Real> draw() {
        pool_.bins.starts.resize(pool_.bins.lay_out(surface_) + 1);
        pool_.bins.points.resize(darts_.size());
        pool_.words.resize(darts_.size());
        pool_.dropped.resize(surface_.classes.shares.empty() ? 0 : darts_.size());
        for (std::uint32_t face = 0; face < surface_.face_count(); ++face) {
            const Grid& grid = pool_.bins.grids[face];
            grid.single() ? draw_cell(face, grid) : draw_cells(face, grid);
        }
        pool_.bins.starts.back() = place_;
        order();
        return std::move(pool_);
    }

  private:
    void add_dart(std::size_t stage, std::uint32_t place, std::uint32_t drawn) {
        const std::uint32_t priority = drawn & ~gpu::kNoDart;
        if (priority != drawn) {
            pool_.dropped[place] = 1;
        }
        pool_.words[place] = order_word(static_cast<std::uint32_t>(stage), priority);
        darts_[next_[stage]++] = make_dart(priority, place);
    }

    void draw_stage(std::uint32_t face, std::size_t stage, std::span<FacePoint<Real>> points) {
        if (points.empty()) {
            return; // Common case in meshes of many faces.
        }
        priorities_.resize(points.size());
        draw_candidates(surface_, params_, face, first_stage_ + static_cast<std::uint32_t>(stage),
                        points, std::span(priorities_));
    }

    /// Keeps the candidates of a face with one cell in the order drawn.
    void draw_cell(std::uint32_t face, const Grid& grid) {
        pool_.bins.starts[grid.first_cell] = place_;
        for (std::size_t stage = 0; stage < counts_.size(); ++stage) {
            const std::uint32_t count = counts_[stage][face];
            draw_stage(face, stage, std::span(pool_.bins.points).subspan(place_, count));
            for (std::uint32_t k = 0; k < count; ++k) {
                add_dart(stage, place_++, priorities_[k]);
            }
        }
    }

    struct Drawn {
        FacePoint<Real> point;
        std::uint32_t stage, priority, cell;
    };

    void draw_cells(std::uint32_t face, const Grid& grid) {
        drawn_.clear();
        cells_.assign(grid.cells(), 0);
        for (std::uint32_t stage = 0; stage < counts_.size(); ++stage) {
            face_points_.resize(counts_[stage][face]);
            draw_stage(face, stage, face_points_);
            for (std::size_t k = 0; k < face_points_.size(); ++k) {
                const std::uint32_t cell = cell_of(surface_, grid, face_points_[k]);
                drawn_.push_back({face_points_[k], stage, priorities_[k], cell});
                ++cells_[cell];
            }
        }
        std::exclusive_scan(cells_.begin(), cells_.end(), cells_.begin(), place_);
        std::copy(cells_.begin(), cells_.end(), pool_.bins.starts.begin() + grid.first_cell);
        for (const Drawn& drawn : drawn_) {
            const std::uint32_t place = cells_[drawn.cell]++;
            pool_.bins.points[place] = drawn.point;
            add_dart(drawn.stage, place, drawn.priority);
        }
        place_ += static_cast<std::uint32_t>(drawn_.size());
    }

    void order() {
        UninitializedVector<Dart> scratch;
        pool_.places.resize(darts_.size());
        for (std::size_t stage = 0; stage < counts_.size(); ++stage) {
            const std::size_t count = starts_[stage + 1] - starts_[stage];
            scratch.resize(std::max(scratch.size(), count));
            const std::span<Dart> darts =
                sort_darts(std::span(darts_).subspan(starts_[stage], count), scratch);
            settle_ties(darts, [this](std::uint32_t a, std::uint32_t b) {
                const FacePoint<Real>& p = pool_.bins.points[a];
                const FacePoint<Real>& q = pool_.bins.points[b];
                if (!params_.face_keys.empty()) { // Whatever the numbers of the faces.
                    return std::tie(p.weight1, p.weight2, p.face) <
                           std::tie(q.weight1, q.weight2, q.face);
                }
                return std::tie(p.face, p.weight1, p.weight2) <
                       std::tie(q.face, q.weight1, q.weight2);
            });
            for (std::size_t i = 0; i < count; ++i) {
                pool_.places[starts_[stage] + i] = candidate_of(darts[i]);
            }
        }
    }

    const Surface<Real>& surface_;
    const SampleParams& params_;
    std::uint32_t first_stage_;
    const Counts& counts_;
    std::vector<std::size_t> starts_; ///< First dart of each stage in dart order, and the end.
    std::vector<std::size_t> next_;   ///< Next dart by stage.
    UninitializedVector<Dart> darts_; ///< Darts of places, by stage.
    Pool<Real> pool_;
    std::uint32_t place_ = 0;
    std::vector<std::uint32_t> priorities_;
    // Scratch memory for a face with many cells.
    std::vector<FacePoint<Real>> face_points_;
    std::vector<Drawn> drawn_;
    std::vector<std::uint32_t> cells_;
};

/// Keeps only the first candidates in dart order.
template <class Real>
void keep_first(Pool<Real>& pool, std::uint32_t count) {
    const std::vector<std::uint32_t> ranks = pool.ranks();
    Bins<Real>& bins = pool.bins;
    std::uint32_t kept = 0;
    std::uint32_t place = 0;
    for (std::size_t cell = 0; cell + 1 < bins.starts.size(); ++cell) {
        bins.starts[cell] = kept;
        for (const std::uint32_t end = bins.starts[cell + 1]; place < end; ++place) {
            if (ranks[place] < count) {
                bins.points[kept] = bins.points[place];
                pool.words[kept] = pool.words[place];
                if (!pool.dropped.empty()) {
                    pool.dropped[kept] = pool.dropped[place];
                }
                pool.places[ranks[place]] = kept;
                ++kept;
            }
        }
    }
    bins.starts.back() = kept;
    bins.points.resize(kept);
    pool.words.resize(kept);
    pool.dropped.resize(pool.dropped.empty() ? 0 : kept);
    pool.places.resize(kept);
}

} // namespace

template <class Real>
std::vector<FacePoint<Real>> Pool<Real>::by_rank() const {
    std::vector<FacePoint<Real>> points;
    points.reserve(places.size());
    for (const std::uint32_t place : places) {
        points.push_back(bins.points[place]);
    }
    return points;
}

template <class Real>
std::vector<std::uint32_t> Pool<Real>::ranks() const {
    std::vector<std::uint32_t> ranks(places.size());
    for (std::uint32_t rank = 0; rank < size(); ++rank) {
        ranks[places[rank]] = rank;
    }
    return ranks;
}

template <class Real>
Pool<Real> draw_stages(const Surface<Real>& surface, const SampleParams& params,
                       std::uint32_t first, std::uint32_t stages) {
    Counts counts;
    for (std::uint32_t stage = first; stage < first + stages; ++stage) {
        counts.push_back(count_candidates(surface, params, stage));
    }
    return Drawing(surface, params, first, counts).draw();
}

template <class Real>
Pool<Real> draw_pool(const Surface<Real>& surface, const SampleParams& params) {
    if (params.darts == 0) {
        return draw_stages(surface, params, 0, surface.frame.stages.pool_stages());
    }
    Counts counts;
    for (std::size_t darts = 0; darts < params.darts;) {
        const auto stage = static_cast<std::uint32_t>(counts.size());
        counts.push_back(count_candidates(surface, params, stage));
        darts = std::accumulate(counts.back().begin(), counts.back().end(), darts);
    }
    Pool<Real> pool = Drawing(surface, params, 0, counts).draw();
    keep_first(pool, params.darts);
    return pool;
}

#define GEODISK_POOL_OF(Real)                                                                      \
    template struct Pool<Real>;                                                                    \
    template Pool<Real> draw_stages(const Surface<Real>&, const SampleParams&, std::uint32_t,      \
                                    std::uint32_t);                                                \
    template Pool<Real> draw_pool(const Surface<Real>&, const SampleParams&);
GEODISK_POOL_OF(float)
GEODISK_POOL_OF(double)
#undef GEODISK_POOL_OF

} // namespace geodisk::ref
