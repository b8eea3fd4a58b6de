#include "geodisk/weld.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "geodisk/detail/vertex_sets.hpp"
#include "mesh/checks.hpp"
#include "mesh/joined_vertices.hpp"
#include "mesh/position_table.hpp"
#include "support/guard.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// Finds pairs of vertices within epsilon, with a grid of the first three coordinates. Cells are
/// sorted so that each row around a cell is contiguous.
class NearPairs {
  public:
    /// `vertices` must be at different positions.
    NearPairs(const MeshView& mesh, double epsilon, std::span<const std::uint32_t> vertices)
        : mesh_(mesh), epsilon_(epsilon), axes_(std::min(mesh.dimension, 3u)) {
        std::array<double, 3> low{};
        for (std::uint32_t axis = 0; axis < axes_; ++axis) {
            low[axis] = HUGE_VAL;
            for (const std::uint32_t v : vertices) {
                low[axis] = std::min(low[axis], mesh.coordinate(v, axis));
            }
        }
        members_.reserve(vertices.size());
        for (const std::uint32_t v : vertices) {
            Member member{{}, v};
            for (std::uint32_t axis = 0; axis < axes_; ++axis) {
                const double x = (mesh.coordinate(v, axis) - low[axis]) / (kSide * epsilon);
                fits_ = fits_ && x <= kMaxCells;
                member.cell[axis] = fits_ ? static_cast<std::int64_t>(x) : 0;
            }
            members_.push_back(member);
        }
        std::sort(members_.begin(), members_.end());
        for (std::size_t i = 0; i < members_.size(); ++i) {
            if (i == 0 || members_[i].cell != members_[i - 1].cell) {
                starts_.push_back(i);
            }
        }
        starts_.push_back(members_.size());
    }

    /// Returns false if rounding is too large for the grid.
    bool fits() const { return fits_; }

    void join(VertexSets& sets) const {
        for (std::size_t cell = 0; cell < cell_count(); ++cell) {
            join_cell(cell, sets);
        }
        for (const auto& [x, y] : kRows) {
            join_row(x, y, sets);
        }
    }

  private:
    struct Member {
        Cell cell;
        std::uint32_t vertex;
        auto operator<=>(const Member&) const = default;
    };

    // Side of a cell in units of epsilon. Vertices with three coordinates in one cell are within
    // epsilon, with some room for rounding, and vertices within epsilon are at most two cells
    // apart.
    static constexpr double kSide = 0.55;
    static constexpr std::int64_t kReach = 2;
    static constexpr double kMaxCells = 0x1p44;
    /// Rows to one side of a cell, nearest first: most cells are joined by then.
    static constexpr std::pair<int, int> kRows[] = {{0, 0}, {0, 1},  {1, 0},  {1, -1}, {1, 1},
                                                    {0, 2}, {2, 0},  {1, -2}, {1, 2},  {2, -1},
                                                    {2, 1}, {2, -2}, {2, 2}};

    std::size_t cell_count() const { return starts_.size() - 1; }
    const Cell& cell_at(std::size_t cell) const { return members_[starts_[cell]].cell; }
    std::span<const Member> members_of(std::size_t cell) const {
        return std::span(members_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
    }

    bool are_near(std::uint32_t a, std::uint32_t b) const {
        double sum = 0;
        for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
            const double d = (mesh_.coordinate(a, axis) - mesh_.coordinate(b, axis)) / epsilon_;
            sum += d * d;
        }
        return sum <= 1;
    }

    void join_cell(std::size_t cell, VertexSets& sets) const {
        const auto members = members_of(cell);
        for (std::size_t i = 1; i < members.size(); ++i) {
            // In up to three dimensions, all vertices of a cell are within epsilon.
            const std::size_t most = cells_are_near() ? 1 : i;
            for (std::size_t k = 0; k < most; ++k) {
                join_near(members[k].vertex, members[i].vertex, sets);
            }
        }
    }

    /// Joins each cell with the cells of the row at this offset, or with later ones in its own row.
    void join_row(std::int64_t x, std::int64_t y, VertexSets& sets) const {
        const bool is_own = x == 0 && y == 0;
        std::size_t next = 0;
        for (std::size_t cell = 0; cell < cell_count(); ++cell) {
            const Cell at = cell_at(cell);
            const Cell first{at[0] + x, at[1] + y, is_own ? at[2] + 1 : at[2] - kReach};
            const Cell last{first[0], first[1], at[2] + kReach};
            while (next < cell_count() && cell_at(next) < first) {
                ++next;
            }
            for (std::size_t other = next; other < cell_count() && cell_at(other) <= last;
                 ++other) {
                join_cells(cell, other, sets);
            }
        }
    }

    void join_cells(std::size_t a, std::size_t b, VertexSets& sets) const {
        for (const Member& from : members_of(a)) {
            for (const Member& to : members_of(b)) {
                if (cells_are_near() && sets.lowest(from.vertex) == sets.lowest(to.vertex)) {
                    return; // All vertices of both cells are joined now.
                }
                join_near(from.vertex, to.vertex, sets);
            }
        }
    }

    bool cells_are_near() const { return mesh_.dimension <= 3; }

    void join_near(std::uint32_t a, std::uint32_t b, VertexSets& sets) const {
        if (are_near(a, b)) {
            sets.join(a, b);
        }
    }

    const MeshView& mesh_;
    double epsilon_;
    std::uint32_t axes_;
    bool fits_ = true;
    std::vector<Member> members_;     ///< Sorted by cell.
    std::vector<std::size_t> starts_; ///< First index of each cell, and the end.
};

std::vector<std::uint32_t> used_vertices(const MeshView& mesh) {
    std::vector<bool> used(mesh.vertex_count(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        used[mesh.triangles[i]] = true;
    }
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (used[v]) {
            vertices.push_back(v);
        }
    }
    return vertices;
}

/// Joins vertices in the same place and returns the lowest one of each place.
std::vector<std::uint32_t> join_equal(const MeshView& mesh, VertexSets& sets) {
    const std::vector<std::uint32_t> vertices = used_vertices(mesh);
    constexpr std::size_t kAhead = 8; // Vertices whose places memory takes time for.
    PositionTable table(mesh);
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i];
        const std::uint32_t soon = vertices[std::min(i + kAhead, vertices.size() - 1)];
        const std::uint32_t first = table.first_at(v, soon);
        if (first == v) {
            places.push_back(v);
        } else {
            sets.join(first, v);
        }
    }
    return places;
}

} // namespace

Result<WeldedMesh> weld(const MeshView& mesh, double epsilon) noexcept {
    return guarded([&]() -> Result<WeldedMesh> {
        if (!(epsilon >= 0) || !std::isfinite(epsilon)) {
            return Error{Status::invalid_argument,
                         "epsilon must be finite and not negative, but it is " +
                             exact_text(epsilon)};
        }
        GEODISK_TRY(check_mesh(mesh));
        VertexSets sets(mesh.vertex_count());
        const std::vector<std::uint32_t> places = join_equal(mesh, sets);
        if (epsilon > 0) {
            const NearPairs pairs(mesh, epsilon, places);
            if (!pairs.fits()) {
                return Error{Status::invalid_argument,
                             "epsilon is too small beside the bounding box of the mesh"};
            }
            pairs.join(sets);
        }
        return with_joined(mesh, sets);
    });
}

} // namespace geodisk
