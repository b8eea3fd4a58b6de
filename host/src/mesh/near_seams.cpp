#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "geodisk/weld.hpp"
#include "mesh/checks.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_loss.hpp"
#include "mesh/seams.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Maximum gap between the ends of two edges: as a part of the shorter edge, since features of the
// mesh should not be that small, and as a part of the bounding box.
constexpr double kPartOfEdge = 1e-2;
constexpr double kPartOfDiagonal = 1e-4;

/// Allows for the rounding in weld().
constexpr double kGapRounding = 1 + 1e-9;

/// Minimum epsilon of weld() with some room, relative to the longest side of the mesh.
constexpr double kMinEpsilon = 0x1p-42;

/// Scales coordinates by a power of two so that the longest side of the borders is about 1. Squares
/// of distances then neither overflow nor vanish.
class ScaledMesh {
  public:
    ScaledMesh(const MeshView& mesh, const std::vector<EdgeEnds>& edges) : mesh_(mesh) {
        double squares = 0;
        for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (const auto& [from, to] : edges) {
                for (const std::uint32_t v : {from, to}) {
                    low = std::min(low, mesh.coordinate(v, axis));
                    high = std::max(high, mesh.coordinate(v, axis));
                }
            }
            longest_side_ = std::max(longest_side_, high - low);
            squares = std::hypot(squares, high - low);
        }
        if (is_sized()) {
            scale_ = std::ldexp(1.0, std::min(-std::ilogb(longest_side_), kMaxExponent));
        }
        diagonal_ = squares * scale_;
    }

    /// Returns false without borders, or if all borders are one point.
    bool is_sized() const { return longest_side_ > 0 && std::isfinite(longest_side_); }
    double diagonal() const { return diagonal_; }
    double in_mesh_units(double length) const { return length / scale_; }

    const MeshView& view() const { return mesh_; }
    double coordinate(std::uint32_t v, std::uint32_t axis) const {
        return mesh_.coordinate(v, axis) * scale_;
    }
    double distance(std::uint32_t a, std::uint32_t b) const {
        double sum = 0;
        for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
            const double d = coordinate(a, axis) - coordinate(b, axis);
            sum += d * d;
        }
        return std::sqrt(sum);
    }

  private:
    static constexpr int kMaxExponent = 1000; // Maximum exponent of a finite scale.

    const MeshView& mesh_;
    double longest_side_ = 0, scale_ = 1, diagonal_ = 0;
};

/// Finds out whether two near vertices share a face.
class ShortEdges {
  public:
    ShortEdges(const ScaledMesh& mesh, double longest) {
        const IndexView triangles = mesh.view().triangles;
        for (std::size_t f = 0; f < mesh.view().face_count(); ++f) {
            const auto face = triangles.face(f);
            for (std::size_t k = 0; k < 3 && takes_part(face); ++k) {
                const std::uint32_t a = face[k], b = face[(k + 1) % 3];
                if (mesh.distance(a, b) <= longest) {
                    edges_.push_back(std::minmax(a, b));
                }
            }
        }
        std::sort(edges_.begin(), edges_.end());
    }

    bool join(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(edges_.begin(), edges_.end(),
                                  std::pair<std::uint32_t, std::uint32_t>(std::minmax(a, b)));
    }

  private:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
};

/// Returns a hash of a cell of EdgeGrid. Cells of a block share its upper bits.
std::uint32_t hash_of(int level, const std::array<double, 3>& cell) {
    // A block is several edges wide, so that edges near each other are visited together.
    constexpr int kCellsPerBlock = 16, kBitsInBlock = 12;
    const auto mixed = [](std::uint64_t hash, double x) {
        hash ^= std::bit_cast<std::uint64_t>(x + 0.0); // Adding 0 turns -0 into 0.
        hash *= 0x9e3779b97f4a7c15;
        return hash ^ hash >> 32;
    };
    std::uint64_t block = static_cast<std::uint64_t>(level), in_block = 0;
    for (const double x : cell) {
        block = mixed(block, std::floor(x / kCellsPerBlock));
        in_block = mixed(in_block, x);
    }
    return static_cast<std::uint32_t>(block >> 32 << kBitsInBlock |
                                      in_block >> (64 - kBitsInBlock));
}

/// Border edges by the cells that their midpoints are in or near, so that edges close to each other
/// share a cell. Cells grow with the length of the edges, so that few edges share a cell even in
/// very small parts of a mesh.
class EdgeGrid {
  public:
    EdgeGrid(const ScaledMesh& mesh, std::vector<EdgeEnds> edges)
        : mesh_(mesh), edges_(std::move(edges)), max_(kPartOfDiagonal * mesh.diagonal()),
          short_edges_(mesh, max_), axes_(std::min(mesh.view().dimension, 3u)) {
        entries_.reserve(edges_.size() + edges_.size() / 4);
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            enter(i);
        }
        std::sort(entries_.begin(), entries_.end());
    }

    /// Gaps of edges to the nearest edge whose ends are close.
    struct Gaps {
        std::uint64_t edges = 0; ///< Number of edges with a gap.
        double largest = 0;      ///< In mesh units.
    };
    /// Finds the gaps of all edges, on several threads.
    Gaps find_gaps(const ThreadOptions& threads) const {
        std::vector<std::atomic<double>> nearest(edges_.size());
        for_blocks(threads, entries_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t last = std::min(entries_.size(), i + 1 + kMaxCandidates);
                for (std::size_t k = i + 1; k < last && cell_at(k) == cell_at(i); ++k) {
                    const double gap = gap_between(edge_at(i), edge_at(k));
                    if (gap > 0) {
                        lower(nearest[edge_at(i)], gap);
                        lower(nearest[edge_at(k)], gap);
                    }
                }
            }
        });
        Gaps all;
        for (const double gap : nearest) {
            all.edges += gap > 0 ? 1 : 0;
            all.largest = std::max(all.largest, mesh_.in_mesh_units(gap));
        }
        return all;
    }

  private:
    // Few edges are near several cells, or of several levels. Coordinates and lengths are often
    // round numbers: these are far from the bounds.
    static constexpr double kCellsPerEdge = 4;
    static constexpr double kShiftOfCells = 0.382; ///< In cells.
    static constexpr double kFactorOfLevels = 1.1;
    /// Limits the time if very many edges share a cell.
    static constexpr std::size_t kMaxCandidates = 256;

    static int level_of(double length) { return std::ilogb(kFactorOfLevels * length); }
    double length_of(std::uint32_t i) const { return mesh_.distance(edges_[i].from, edges_[i].to); }
    std::uint32_t cell_at(std::size_t entry) const {
        return static_cast<std::uint32_t>(entries_[entry] >> 32);
    }
    std::uint32_t edge_at(std::size_t entry) const {
        return static_cast<std::uint32_t>(entries_[entry]);
    }

    /// Enters an edge in all cells within half its largest gap, at the levels of all lengths within
    /// its largest gap. Edges with a gap then share a cell.
    void enter(std::uint32_t i) {
        const double length = length_of(i);
        if (!(length > 0)) {
            return;
        }
        const double gap = std::min(kPartOfEdge * length, max_);
        const int last = level_of(length + gap);
        for (int level = level_of(length - gap); level <= last; ++level) {
            const double side = std::ldexp(1 / kCellsPerEdge, level);
            std::array<double, 3> low{}, high{};
            for (std::uint32_t axis = 0; axis < axes_; ++axis) {
                const double middle = mesh_.coordinate(edges_[i].from, axis) / 2 +
                                      mesh_.coordinate(edges_[i].to, axis) / 2;
                low[axis] = std::floor((middle - gap / 2) / side + kShiftOfCells);
                high[axis] = std::floor((middle + gap / 2) / side + kShiftOfCells);
            }
            for (unsigned choice = 0; choice < 1u << axes_; ++choice) {
                std::array<double, 3> cell = low;
                bool is_new = true;
                for (std::uint32_t axis = 0; axis < axes_; ++axis) {
                    if ((choice >> axis & 1u) != 0) {
                        is_new = is_new && high[axis] != low[axis];
                        cell[axis] = high[axis];
                    }
                }
                if (is_new) {
                    entries_.push_back(std::uint64_t{hash_of(level, cell)} << 32 | i);
                }
            }
        }
    }

    /// Sets `nearest` to a gap unless it has a smaller one already.
    static void lower(std::atomic<double>& nearest, double gap) {
        double known = nearest;
        while ((known == 0 || gap < known) && !nearest.compare_exchange_weak(known, gap)) {
        }
    }

    /// Returns the gap between two edges; 0 if they coincide or are not close.
    double gap_between(std::uint32_t i, std::uint32_t k) const {
        const double radius = std::min(kPartOfEdge * std::min(length_of(i), length_of(k)), max_);
        const auto [a, b] = edges_[i];
        auto [c, d] = edges_[k];
        if (mesh_.distance(a, c) > radius) {
            std::swap(c, d);
        }
        const double gap = std::max(mesh_.distance(a, c), mesh_.distance(b, d));
        // Edges of a narrow part of the surface are near each other without a seam.
        return gap <= radius && !short_edges_.join(a, c) && !short_edges_.join(b, d) ? gap : 0;
    }

    const ScaledMesh& mesh_;
    std::vector<EdgeEnds> edges_;
    double max_;
    ShortEdges short_edges_;
    std::uint32_t axes_;
    /// The hash of a cell in the upper half, an edge in the lower. Sorted.
    std::vector<std::uint64_t> entries_;
};

/// Returns the smallest number of at least `least` with `digits` digits, or for 0 digits a power of
/// ten.
double rounded_up(double least, int digits) {
    const int exponent = static_cast<int>(std::floor(std::log10(least))) - std::max(digits - 1, 0);
    for (int more = 0;; ++more) {
        const auto number = [&](long long mantissa) {
            const std::string text =
                std::to_string(mantissa) + "e" + std::to_string(exponent + (digits > 0 ? 0 : more));
            double value = 0;
            std::from_chars(text.data(), text.data() + text.size(), value);
            return value;
        };
        const double value =
            digits > 0 ? number(std::llround(std::floor(least * std::pow(10.0, -exponent))) + more)
                       : number(1);
        if (value >= least) {
            return value;
        }
    }
}

/// Returns the longest side of the bounding box of all vertices that faces name, as weld() takes
/// it.
double longest_side_of(const MeshView& mesh) {
    double longest = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const double x = mesh.coordinate(mesh.triangles[i], axis);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        longest = std::max(longest, high - low);
    }
    return longest;
}

/// Chooses an epsilon that joins all of them: round and, if possible, without loss of faces.
Result<Done> choose_epsilon(const MeshView& mesh, double least, NearSeams& seams) {
    for (const int digits : {0, 1, 3}) {
        const double epsilon = rounded_up(least, digits);
        seams.epsilon = epsilon;
        if (keeps_all_faces(mesh, epsilon)) {
            seams.degenerate_faces = 0;
            break;
        }
        const auto welded = weld(mesh, epsilon);
        GEODISK_TRY(welded);
        seams.degenerate_faces = welded->degenerate_faces;
        if (welded->degenerate_faces == 0) {
            break;
        }
    }
    return Done{};
}

} // namespace

Result<NearSeams> find_near_seams(const MeshView& mesh, const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<NearSeams> {
        GEODISK_TRY(check_mesh(mesh));
        GEODISK_TRY(check_threads(threads));
        NearSeams seams;
        std::vector<EdgeEnds> borders = border_edges(mesh);
        const ScaledMesh scaled(mesh, borders);
        if (!scaled.is_sized()) {
            return seams;
        }
        const EdgeGrid::Gaps gaps = EdgeGrid(scaled, std::move(borders)).find_gaps(threads);
        seams.edges = gaps.edges;
        seams.gap = gaps.largest;
        if (seams.edges > 0) {
            const double gap = kGapRounding * seams.gap;
            const double least = kMinEpsilon * longest_side_of(mesh);
            GEODISK_TRY(choose_epsilon(mesh, std::max(gap, least), seams));
            if (gap < least && seams.degenerate_faces > 0) { // Wider than the gap, so too much.
                seams.epsilon = 0;
                seams.degenerate_faces = 0;
            }
        }
        // If as many triangles vanish as edges join, the surface itself is that narrow.
        return seams.degenerate_faces < std::max<std::uint64_t>(seams.edges, 1) ? seams
                                                                                : NearSeams{};
    });
}

} // namespace geodisk
