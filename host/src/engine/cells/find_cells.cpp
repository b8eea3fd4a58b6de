#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <geodisk/cells.hpp>

#include "engine/cells/cell_splitter.hpp"
#include "engine/cells/cells_of.hpp"
#include "engine/cells/dual_graph.hpp"
#include "mesh/face_area.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// The longest edge of the grid, in parts of the smallest disk, but not too small for the largest.
constexpr double kSmallestCell = 0x1p-14;
constexpr double kSmallestOfAll = 0x1p-20;
constexpr std::uint32_t kFacesPerPart = 256;
constexpr std::size_t kPartsAtOnce = 64;

std::uint32_t grid_level(const JobFrame& frame, const LitCells& lit) {
    const double step =
        std::max(kSmallestCell * lit.smallest_radius(), kSmallestOfAll * lit.largest_radius());
    const double splits = std::ceil(std::log2(std::max(2.0, frame.longest_edge / step)));
    return static_cast<std::uint32_t>(std::min<double>(splits, kMaxSplits - 1));
}

class CellSearch {
  public:
    CellSearch(const PreparedMesh& mesh, const LitSamples& samples, const ThreadOptions& threads,
               const ProgressCallback& progress)
        : mesh_(mesh), samples_(samples), lit_(*samples.lit), threads_(threads),
          progress_(progress), grid_(mesh, grid_level(samples.frame, lit_)) {
        cells_.areas.resize(samples.samples.size(), 0);
        doubts_.resize(samples.samples.size(), 0);
    }

    Result<SurfaceCells> go();

  private:
    void split(std::uint32_t part, FoundCells& found) const;
    void add(const FoundCells& found);
    bool report(double part) const;

    const PreparedMesh& mesh_;
    const LitSamples& samples_;
    const LitCells& lit_;
    const ThreadOptions& threads_;
    const ProgressCallback& progress_;
    GridPoints grid_;
    SurfaceCells cells_;
    std::vector<double> doubts_;
    std::vector<std::array<std::uint32_t, 2>> pairs_;
    std::vector<Meeting> meetings_;
    std::vector<KnotEnd> ends_;
    std::uint32_t knots_ = 0;
};

void CellSearch::split(std::uint32_t part, FoundCells& found) const {
    CellSplitter splitter(lit_.faces(), grid_, lit_.closeness(), samples_.params.has_dual);
    const std::uint32_t first = part * kFacesPerPart;
    const std::uint32_t end = std::min(first + kFacesPerPart, mesh_.face_count());
    for (std::uint32_t face = first; face < end; ++face) {
        const std::span<const std::uint8_t> mask = samples_.params.face_mask;
        if (has_area(mesh_, face) && (mask.empty() || mask[face] != 0)) {
            splitter.split(face, found);
        }
    }
    CellSplitter::merge(found);
}

void CellSearch::add(const FoundCells& found) {
    for (const auto& [sample, area, doubt] : found.shares) {
        cells_.areas[sample] += area;
        doubts_[sample] += doubt;
    }
    cells_.unreached += found.unreached;
    pairs_.insert(pairs_.end(), found.pairs.begin(), found.pairs.end());
    for (Meeting meeting : found.meetings) {
        meeting.knot += knots_;
        meetings_.push_back(meeting);
    }
    for (KnotEnd end : found.ends) {
        end.knot += knots_;
        ends_.push_back(end);
    }
    knots_ += found.knots;
}

bool CellSearch::report(double part) const {
    const auto all = static_cast<std::uint32_t>(cells_.areas.size());
    return !progress_ || progress_({all + static_cast<std::uint32_t>(part * all), 2 * all, all,
                                    lit_.report().disks, lit_.report().windows});
}

Result<SurfaceCells> CellSearch::go() {
    const std::uint32_t parts = (mesh_.face_count() + kFacesPerPart - 1) / kFacesPerPart;
    for (std::uint32_t first = 0; first < parts; first += kPartsAtOnce) {
        const std::size_t count = std::min<std::size_t>(kPartsAtOnce, parts - first);
        std::vector<FoundCells> found(count);
        for_parts(threads_, count,
                  [&](std::size_t i) { split(first + static_cast<std::uint32_t>(i), found[i]); });
        for (const FoundCells& part : found) {
            add(part);
        }
        if (!report(static_cast<double>(first + count) / parts)) {
            return Error{Status::cancelled, "cancelled"};
        }
    }
    const double square = samples_.frame.unit * samples_.frame.unit;
    for (double& area : cells_.areas) {
        area *= square;
    }
    cells_.unreached *= square;
    cells_.area_error = *std::ranges::max_element(doubts_) * square;
    cells_.distance_error = samples_.distance_error();
    if (samples_.params.has_dual) {
        cells_.triangles = dual_triangles(std::move(meetings_), std::move(ends_), knots_);
        cells_.edges = dual_edges(std::move(pairs_), cells_.triangles);
        cells_.dual = dual_report(mesh_, cells_);
    }
    cells_.report = lit_.report();
    return std::move(cells_);
}

/// Names samples by their numbers among all.
void renumber(SurfaceCells& cells, std::span<const std::uint32_t> numbers, std::size_t all) {
    if (numbers.size() == all) {
        return;
    }
    std::vector<double> areas(all, 0);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        areas[numbers[i]] = cells.areas[i];
    }
    cells.areas = std::move(areas);
    for (auto& edge : cells.edges) {
        edge = {numbers[edge[0]], numbers[edge[1]]};
    }
    for (auto& [a, b, c] : cells.triangles) {
        a = numbers[a], b = numbers[b], c = numbers[c];
    }
}

} // namespace

Result<SurfaceCells> cells_of(const PreparedMesh& mesh, const LitSamples& samples,
                              const ThreadOptions& threads, const ProgressCallback& progress) {
    auto cells = CellSearch(mesh, samples, threads, progress).go();
    if (cells) {
        renumber(*cells, samples.numbers, samples.all);
    }
    return cells;
}

Result<SurfaceCells> find_cells(Runner& runner, const PreparedMesh& mesh,
                                std::span<const Sample> samples, const CellParams& params,
                                const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SurfaceCells> {
        Runner::Impl& impl = Runner::Impl::of(runner);
        const auto lit = impl.complete(LitSamples::make(impl, mesh, samples, params),
                                       2 * static_cast<std::uint32_t>(samples.size()), progress);
        GEODISK_TRY(lit);
        const double start = impl.now();
        auto cells = cells_of(mesh, **lit, impl.options.threads, progress);
        if (cells) {
            cells->report.seconds.sample += impl.now() - start;
        }
        return cells;
    });
}

} // namespace geodisk
