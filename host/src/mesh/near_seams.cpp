#include <algorithm>
#include <array>
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
#include "mesh/seams.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

// How far apart the ends of two edges may be: a part of the shorter edge, which no feature of the
// mesh should be as small as, and of the bounding box.
constexpr double kPartOfEdge = 1e-2;
constexpr double kPartOfDiagonal = 1e-4;

/// What weld() rounds when it compares distances, with some room.
constexpr double kRounding = 1 + 1e-9;

/// What weld() takes at least, with some room, as a part of the longest side.
constexpr double kLeastEpsilon = 0x1p-42;

using Place = std::array<double, kMostDimensions>;

struct Box {
    double diagonal = 0, longest_side = 0;
};

Box box_of(const MeshView& mesh, const std::vector<EdgeEnds>& edges) {
    Box box;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& [from, to] : edges) {
            for (const std::uint32_t v : {from, to}) {
                low = std::min(low, mesh.coordinate(v, axis));
                high = std::max(high, mesh.coordinate(v, axis));
            }
        }
        box.longest_side = std::max(box.longest_side, high - low);
        box.diagonal = std::hypot(box.diagonal, high - low);
    }
    return box;
}

double distance(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    double length = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        length = std::hypot(length, mesh.coordinate(a, axis) - mesh.coordinate(b, axis));
    }
    return length;
}

/// Whether two vertices share a face, for those that are near each other.
class ShortEdges {
  public:
    ShortEdges(const MeshView& mesh, double longest) {
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const auto face = mesh.triangles.face(f);
            for (std::size_t k = 0; k < 3 && takes_part(face); ++k) {
                const std::uint32_t a = face[k], b = face[(k + 1) % 3];
                if (distance(mesh, a, b) <= longest) {
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

/// Border edges in a grid by their midpoints. Its cells grow with the length of the edges, so that
/// few edges share a cell however small the parts of the mesh are.
class EdgeGrid {
  public:
    EdgeGrid(const MeshView& mesh, std::vector<EdgeEnds> edges, double diagonal)
        : mesh_(mesh), edges_(std::move(edges)), most_(kPartOfDiagonal * diagonal),
          short_edges_(mesh, most_), axes_(std::min(mesh.dimension, 3u)) {
        members_.reserve(edges_.size());
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            const double length = length_of(i);
            if (length > 0) {
                const int level = level_of(length);
                members_.push_back({level, cell_of(midpoint(i), level, 0), i});
            }
        }
        std::sort(members_.begin(), members_.end());
    }

    std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges_.size()); }

    /// Distance to the nearest other edge whose ends are close to those of edge `i`; 0 for none.
    double gap_of(std::uint32_t i) const {
        const double length = length_of(i);
        const double radius = std::min(kPartOfEdge * length, most_);
        double nearest = 0;
        if (!(length > 0)) {
            return nearest;
        }
        const int last = level_of(length + 2 * radius);
        for (int level = level_of(length - 2 * radius); level <= last; ++level) {
            const Cell low = cell_of(midpoint(i), level, -radius);
            const Cell high = cell_of(midpoint(i), level, radius);
            for (Cell cell = low; cell[0] <= high[0]; ++cell[0]) {
                for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
                    for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
                        look_in({level, cell, 0}, i, radius, nearest);
                    }
                }
            }
        }
        return nearest;
    }

  private:
    using Cell = std::array<double, 3>;
    struct Member {
        int level;
        Cell cell;
        std::uint32_t edge;
        auto operator<=>(const Member&) const = default;
    };

    // So that most neighbourhoods lie in one cell.
    static constexpr double kCellsPerEdge = 8;
    /// Bounds the time where very many edges share a cell.
    static constexpr int kMostCandidates = 256;

    double length_of(std::uint32_t i) const {
        return distance(mesh_, edges_[i].from, edges_[i].to);
    }
    static int level_of(double length) { return std::ilogb(length); }

    Place midpoint(std::uint32_t i) const {
        Place place{};
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            place[axis] = mesh_.coordinate(edges_[i].from, axis) / 2 +
                          mesh_.coordinate(edges_[i].to, axis) / 2;
        }
        return place;
    }
    Cell cell_of(const Place& place, int level, double shift) const {
        const double side = std::ldexp(1 / kCellsPerEdge, level);
        Cell cell{};
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            cell[axis] = std::floor((place[axis] + shift) / side);
        }
        return cell;
    }

    void look_in(const Member& cell, std::uint32_t i, double radius, double& nearest) const {
        auto at = std::lower_bound(members_.begin(), members_.end(), cell);
        for (int looked_at = 0; at != members_.end() && at->level == cell.level &&
                                at->cell == cell.cell && looked_at < kMostCandidates;
             ++at, ++looked_at) {
            const double gap = at->edge == i ? 0 : gap_between(i, at->edge, radius);
            if (gap > 0 && (nearest == 0 || gap < nearest)) {
                nearest = gap;
            }
        }
    }

    /// 0 where the edges coincide or are no near misses.
    double gap_between(std::uint32_t i, std::uint32_t k, double radius) const {
        radius = std::min(radius, kPartOfEdge * length_of(k));
        const auto [a, b] = edges_[i];
        auto [c, d] = edges_[k];
        if (distance(mesh_, a, c) > radius) {
            std::swap(c, d);
        }
        const double gap = std::max(distance(mesh_, a, c), distance(mesh_, b, d));
        // Across a narrow part of the surface, edges are near each other as they should be.
        return gap <= radius && !short_edges_.join(a, c) && !short_edges_.join(b, d) ? gap : 0;
    }

    const MeshView& mesh_;
    std::vector<EdgeEnds> edges_;
    double most_;
    ShortEdges short_edges_;
    std::uint32_t axes_;
    std::vector<Member> members_;
};

/// The next number of `digits` digits, or of a single 1 for none, that is at least `least`.
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

/// Fills in a number that joins all of them, round and, if there is one, without loss of faces.
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

Result<NearSeams> find_near_seams(const MeshView& mesh) noexcept {
    return guarded([&]() -> Result<NearSeams> {
        if (auto checked = check_mesh(mesh); !checked) {
            return checked.error();
        }
        NearSeams seams;
        std::vector<EdgeEnds> borders = border_edges(mesh);
        const Box box = box_of(mesh, borders);
        if (borders.empty() || !std::isfinite(box.diagonal)) {
            return seams;
        }
        const EdgeGrid grid(mesh, std::move(borders), box.diagonal);
        for (std::uint32_t i = 0; i < grid.edge_count(); ++i) {
            const double gap = grid.gap_of(i);
            seams.edges += gap > 0 ? 1 : 0;
            seams.gap = std::max(seams.gap, gap);
        }
        if (seams.edges > 0) {
            const double least = std::max(kRounding * seams.gap, kLeastEpsilon * box.longest_side);
            if (auto chosen = choose_epsilon(mesh, least, seams); !chosen) {
                return chosen.error();
            }
        }
        // As many triangles as edges: then the surface itself is that narrow.
        return seams.degenerate_faces < std::max<std::uint64_t>(seams.edges, 1) ? seams
                                                                                : NearSeams{};
    });
}

} // namespace geodisk
