#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "geodisk/weld.hpp"
#include "mesh/checks.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/seams.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

// Maximum gap between the ends of two edges: as a part of the shorter edge, since features of the
// mesh should not be that small, and as a part of the bounding box.
constexpr double kPartOfEdge = 1e-2;
constexpr double kPartOfDiagonal = 1e-4;

/// Allows for the rounding in weld().
constexpr double kRounding = 1 + 1e-9;

/// Minimum epsilon of weld() with some room, relative to the longest side.
constexpr double kLeastEpsilon = 0x1p-42;

using Place = std::array<double, kMostDimensions>;

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
            scale_ = std::ldexp(1.0, std::min(-std::ilogb(longest_side_), kMostExponent));
        }
        diagonal_ = squares * scale_;
    }

    /// Returns false without borders, or if all borders are one point.
    bool is_sized() const { return longest_side_ > 0 && std::isfinite(longest_side_); }
    double longest_side() const { return longest_side_; } ///< In mesh units.
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
    static constexpr int kMostExponent = 1000; // Maximum exponent of a finite scale.

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

/// A cell of EdgeGrid. Cells of one level have the same size.
struct EdgeCell {
    int level = 0;
    std::array<double, 3> at{};

    /// Returns a hash. Cells of a block have consecutive numbers.
    std::uint64_t hash() const {
        std::uint64_t block = static_cast<std::uint64_t>(level), cell = 0;
        for (const double x : at) {
            block = mixed(block, std::floor(x / kPerBlock));
            cell = mixed(cell, x);
        }
        return block * kNumbersOfBlock + (cell >> 32) % kNumbersOfBlock;
    }

  private:
    /// Cells per block. A block is several edges wide, so that an edge meets only one or two
    /// hashes.
    static constexpr int kPerBlock = 32;
    static constexpr std::uint64_t kNumbersOfBlock = 64;

    static std::uint64_t mixed(std::uint64_t hash, double x) {
        hash ^= std::bit_cast<std::uint64_t>(x + 0.0); // Adding 0 turns -0 into 0.
        hash *= 0x9e3779b97f4a7c15;
        return hash ^ hash >> 32;
    }
};

/// Grid of border edges by their midpoints. Cells grow with the length of the edges, so that few
/// edges share a cell even in very small parts of a mesh.
class EdgeGrid {
  public:
    EdgeGrid(const ScaledMesh& mesh, std::vector<EdgeEnds> edges)
        : mesh_(mesh), edges_(std::move(edges)), most_(kPartOfDiagonal * mesh.diagonal()),
          short_edges_(mesh, most_), axes_(std::min(mesh.view().dimension, 3u)),
          mask_(std::bit_ceil(edges_.size()) - 1), starts_(mask_ + 2), members_(edges_.size()) {
        std::vector<std::uint64_t> hashes(edges_.size());
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            const double length = length_of(i);
            hashes[i] = length > 0 ? cell_of(midpoint(i), level_of(length), 0).hash() : i;
            ++starts_[(hashes[i] & mask_) + 1];
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            members_[next[hashes[i] & mask_]++] = {tag_of(hashes[i]), i};
        }
    }

    /// Gaps of edges to the nearest edge whose ends are close.
    struct Gaps {
        std::uint64_t edges = 0; ///< Number of edges with a gap.
        double largest = 0;      ///< In mesh units.
    };
    /// Finds the gaps of all edges, on several threads. Neighbouring edges are visited together.
    Gaps find_gaps(const ThreadOptions& threads) const {
        std::vector<Gaps> found(block_count(members_.size()));
        for_blocks(threads, members_.size(), [&](std::size_t begin, std::size_t end) {
            Gaps& own = found[begin / kBlock];
            for (std::size_t i = begin; i < end; ++i) {
                const double gap = mesh_.in_mesh_units(gap_of(members_[i].edge));
                own.edges += gap > 0 ? 1 : 0;
                own.largest = std::max(own.largest, gap);
            }
        });
        Gaps all;
        for (const Gaps& gaps : found) {
            all.edges += gaps.edges;
            all.largest = std::max(all.largest, gaps.largest);
        }
        return all;
    }

  private:
    struct Member {
        std::uint32_t tag = 0; ///< Identifies the cell among those in the bucket.
        std::uint32_t edge = 0;
    };

    // Cell size: most neighbourhoods lie in one cell, and all in two along each axis.
    static constexpr double kCellsPerEdge = 8;
    /// Limits the time if very many edges share a cell.
    static constexpr int kMostCandidates = 256;

    static std::uint32_t tag_of(std::uint64_t hash) {
        return static_cast<std::uint32_t>(hash >> 32);
    }
    static int level_of(double length) { return std::ilogb(length); }
    double length_of(std::uint32_t i) const { return mesh_.distance(edges_[i].from, edges_[i].to); }

    Place midpoint(std::uint32_t i) const {
        Place place{};
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            place[axis] = mesh_.coordinate(edges_[i].from, axis) / 2 +
                          mesh_.coordinate(edges_[i].to, axis) / 2;
        }
        return place;
    }
    EdgeCell cell_of(const Place& place, int level, double shift) const {
        const double side = std::ldexp(1 / kCellsPerEdge, level);
        EdgeCell cell{level, {}};
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            cell.at[axis] = std::floor((place[axis] + shift) / side);
        }
        return cell;
    }

    double gap_of(std::uint32_t i) const {
        const double length = length_of(i);
        double nearest = 0;
        if (!(length > 0)) {
            return nearest;
        }
        const Place middle = midpoint(i);
        const double radius = std::min(kPartOfEdge * length, most_);
        const int last = level_of(length + 2 * radius);
        for (int level = level_of(length - 2 * radius); level <= last; ++level) {
            const EdgeCell low = cell_of(middle, level, -radius);
            const EdgeCell high = cell_of(middle, level, radius);
            for (unsigned choice = 0; choice < 1u << axes_; ++choice) {
                EdgeCell cell = low;
                bool is_new = true;
                for (std::uint32_t axis = 0; axis < axes_; ++axis) {
                    if ((choice >> axis & 1u) != 0) {
                        is_new = is_new && high.at[axis] != low.at[axis];
                        cell.at[axis] = high.at[axis];
                    }
                }
                if (is_new) {
                    look_in(cell, i, radius, nearest);
                }
            }
        }
        return nearest;
    }

    void look_in(const EdgeCell& cell, std::uint32_t i, double radius, double& nearest) const {
        const std::uint64_t hash = cell.hash();
        int looked_at = 0;
        for (std::uint32_t at = starts_[hash & mask_];
             at < starts_[(hash & mask_) + 1] && looked_at < kMostCandidates; ++at) {
            const Member& other = members_[at];
            if (other.tag != tag_of(hash) || other.edge == i) {
                continue;
            }
            ++looked_at;
            const double gap = gap_between(i, other.edge, radius);
            if (gap > 0 && (nearest == 0 || gap < nearest)) {
                nearest = gap;
            }
        }
    }

    /// Returns the gap between two edges; 0 if they coincide or are not close.
    double gap_between(std::uint32_t i, std::uint32_t k, double radius) const {
        radius = std::min(radius, kPartOfEdge * length_of(k));
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
    double most_;
    ShortEdges short_edges_;
    std::uint32_t axes_;
    std::uint64_t mask_;                ///< Number of buckets, a power of two, minus 1.
    std::vector<std::uint32_t> starts_; ///< First index of each bucket in members_, and the end.
    std::vector<Member> members_;
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

/// Chooses an epsilon that joins all of them: round and, if possible, without loss of faces.
Result<Done> choose_epsilon(const MeshView& mesh, double least, NearSeams& seams) {
    for (const int digits : {0, 1, 3}) {
        const double epsilon = rounded_up(least, digits);
        const auto welded = weld(mesh, epsilon);
        if (!welded) {
            return welded.error();
        }
        seams.epsilon = epsilon;
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
        if (auto checked = check_mesh(mesh); !checked) {
            return checked.error();
        }
        if (auto checked = check_threads(threads); !checked) {
            return checked.error();
        }
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
            const double least =
                std::max(kRounding * seams.gap, kLeastEpsilon * scaled.longest_side());
            if (auto chosen = choose_epsilon(mesh, least, seams); !chosen) {
                return chosen.error();
            }
        }
        // If as many triangles vanish as edges join, the surface itself is that narrow.
        return seams.degenerate_faces < std::max<std::uint64_t>(seams.edges, 1) ? seams
                                                                                : NearSeams{};
    });
}

} // namespace geodisk
