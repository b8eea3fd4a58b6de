#include "engine/maximal/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <geodisk/detail/philox.hpp>

#include "engine/domain/face_mask.hpp"
#include "mesh/face_area.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

// Cells per task of a thread.
constexpr std::size_t kCellsPerPart = 512;
// Area of an equilateral triangle whose corners are 1 from its centroid.
constexpr double kUnitArea = 1.299038105676658;
// Keeps the random words of these darts apart from those of a pool.
constexpr std::uint64_t kSeedOfGaps = 0x6d6178696d616c00;
// From so many splits on every cell gets a dart: few points are left in it.
constexpr std::uint32_t kLastSplits = 22;

/// Returns a point of the cell with weights that are multiples of 2^-24, given two random words.
ListedCandidate point_in(const GapCell& cell, std::uint32_t a, std::uint32_t b) {
    if (std::uint64_t{a} + b > 0xffffffff) {
        a = ~a;
        b = ~b;
    }
    const std::uint32_t below = 8 + cell.level;
    const auto weight = [&](std::uint32_t at, std::uint32_t random) {
        const std::uint64_t steps = cell.is_turned ? ((std::uint64_t{at} + 1) << 32) - random - 1
                                                   : (std::uint64_t{at} << 32) + random;
        return static_cast<std::uint32_t>(steps >> below);
    };
    return {cell.face, weight(cell.column, a), weight(cell.row, b)};
}

FaceWeights weights_of(const ListedCandidate& candidate) {
    return {candidate.weight1 * 0x1p-24, candidate.weight2 * 0x1p-24};
}

} // namespace

/// Splits cells one by one, and collects what is left of them.
class Gaps::Splitter {
  public:
    Splitter(const LitFaces& lit, double goal, Part& part) : lit_(lit), goal_(goal), part_(part) {}

    /// Tests a cell against the lights on the stack from `first` on, and then its parts.
    void split(const GapCell& cell, std::size_t first) {
        ++part_.tested;
        const std::size_t end = stack_.size();
        const LitFaces::Target target = lit_.target(cell);
        for (std::size_t i = first; i < end; ++i) {
            const Cover cover = lit_.cover(stack_[i], target);
            if (cover == Cover::all) {
                stack_.resize(end);
                return;
            }
            if (cover == Cover::some) {
                stack_.push_back(stack_[i]);
            }
        }
        const bool is_open = stack_.size() == end;
        if (is_open || target.reach <= goal_ * target.spacing() || cell.level == kMaxSplits) {
            keep(cell, end);
        } else {
            for (const GapCell& child : cell.children()) {
                split(child, end);
            }
        }
        stack_.resize(end);
    }

    void begin(std::span<const std::uint32_t> lights, std::span<const std::uint32_t> more) {
        stack_.assign(lights.begin(), lights.end());
        stack_.insert(stack_.end(), more.begin(), more.end());
    }

  private:
    void keep(const GapCell& cell, std::size_t first) {
        part_.cells.push_back({cell, 0, static_cast<std::uint32_t>(part_.lights.size()),
                               static_cast<std::uint32_t>(stack_.size() - first)});
        part_.lights.insert(part_.lights.end(), stack_.begin() + static_cast<std::ptrdiff_t>(first),
                            stack_.end());
    }

    const LitFaces& lit_;
    double goal_;
    Part& part_;
    std::vector<std::uint32_t> stack_;
};

Gaps::Gaps(const LitFaces& lit, const PreparedMesh& mesh, const SampleParams& params,
           const ThreadOptions& threads)
    : lit_(lit), params_(params), threads_(threads), lists_(1) {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (takes_samples(params, face) && has_area(mesh, face)) {
            cells_.push_back({{face, 0, 0, 0, false}, 0, 0, 0});
        }
    }
}

void Gaps::split(std::span<const Living> cells, double goal, Part& part) const {
    Splitter splitter(lit_, goal, part);
    for (const Living& living : cells) {
        splitter.begin(lights_of(living), lit_.lights_of(living.cell.face));
        splitter.split(living.cell, 0);
    }
}

void Gaps::refine(double goal) {
    const std::size_t count = (cells_.size() + kCellsPerPart - 1) / kCellsPerPart;
    std::vector<Part> parts(count);
    for_parts(threads_, count, [&](std::size_t number) {
        const std::size_t first = number * kCellsPerPart;
        const std::size_t length = std::min(kCellsPerPart, cells_.size() - first);
        split(std::span(cells_).subspan(first, length), goal, parts[number]);
    });
    cells_.clear();
    lists_.resize(count);
    for (std::size_t number = 0; number < count; ++number) {
        for (Living& living : parts[number].cells) {
            living.part = static_cast<std::uint32_t>(number);
            cells_.push_back(living);
        }
        lists_[number] = std::move(parts[number].lights);
        tested_ += parts[number].tested;
    }
}

bool Gaps::are_smallest() const {
    return std::ranges::all_of(
        cells_, [](const Living& living) { return living.cell.level == kMaxSplits; });
}

std::vector<ListedCandidate> Gaps::darts(std::uint32_t round, double goal, double most) const {
    const auto share_of = [&](const GapCell& cell) {
        const double side = goal * lit_.target(cell).spacing() / cell.step();
        return lit_.area(cell.face) / (kUnitArea * side * side);
    };
    double sum = 0;
    for (const Living& living : cells_) {
        sum += share_of(living.cell);
    }
    const double part_of_all = std::min(1.0, most / sum);
    struct Dart {
        std::uint64_t priority;
        ListedCandidate at;
        auto key() const { return std::tuple(priority, at.face, at.weight1, at.weight2); }
    };
    std::vector<Dart> darts;
    const std::uint64_t seed = params_.seed ^ kSeedOfGaps;
    for (const Living& living : cells_) {
        const GapCell& cell = living.cell;
        const std::uint32_t key =
            params_.face_keys.empty() ? cell.face : params_.face_keys[cell.face];
        const std::uint32_t kind = round << 8 | std::uint32_t{cell.level} << 1 |
                                   static_cast<std::uint32_t>(cell.is_turned);
        const auto own = philox(seed, {key, kind, cell.column, cell.row});
        const double mean = share_of(cell) * part_of_all;
        const double part = mean - std::floor(mean);
        std::uint32_t count = static_cast<std::uint32_t>(mean) + (own[0] * 0x1p-32 < part ? 1 : 0);
        count = cell.level >= kLastSplits ? std::max(count, 1u) : count;
        const std::uint64_t seed_of_cell = std::uint64_t{own[1]} << 32 | own[2];
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto random = philox(seed_of_cell, {own[3], k, kind, key});
            const ListedCandidate at = point_in(cell, random[2], random[3]);
            const LitFaces::Target target = lit_.target(at.face, weights_of(at));
            const bool is_covered = std::ranges::any_of(lights_of(living), [&](std::uint32_t i) {
                return lit_.cover(i, target) == Cover::all;
            });
            if (!is_covered) {
                darts.push_back({std::uint64_t{random[0]} << 32 | random[1], at});
            }
        }
    }
    std::ranges::sort(darts, {}, &Dart::key);
    std::vector<ListedCandidate> candidates;
    candidates.reserve(darts.size());
    for (const Dart& dart : darts) {
        candidates.push_back(dart.at);
    }
    return candidates;
}

double Gaps::largest_excess() const {
    double largest = 0;
    for (const Living& living : cells_) {
        const LitFaces::Target target = lit_.target(living.cell);
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t light : lights_of(living)) {
            least = std::min(least, lit_.excess(light, target));
        }
        largest = std::max(largest, least);
    }
    return largest;
}

} // namespace geodisk
