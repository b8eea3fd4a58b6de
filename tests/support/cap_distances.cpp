#include "support/cap_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "lib/frame.hpp"
#include "support/geodesic_query.hpp"
#include "support/unfolding.hpp"

namespace geodisk::test {
namespace {

/// Returns true if all edges of a face are so short that paths from outside may miss it: lengths
/// below 2^-40 of the reach count as 0.
bool is_below_resolution(const PreparedMesh& surface, std::uint32_t face, double reach) {
    const auto edges = surface.half_edges().subspan(std::size_t{3} * face, 3);
    return std::ranges::all_of(
        edges, [reach](const HalfEdge& edge) { return edge.length < 0x1p-30 * reach; });
}

/// Compares tables with the true one.
class Comparison {
  public:
    /// Points that `ignores` are not looked for.
    Comparison(const DistanceTable& truth, double reach, std::vector<bool> ignores)
        : truth_(truth), reach_(reach), ignores_(std::move(ignores)) {}

    /// Adds what is wrong by more than `error`. `from(a)` returns the distances from point a to
    /// all, or nothing.
    template <class From>
    void add(const char* kind, double error, const From& from) {
        for (std::size_t a = 0; a < truth_.size(); ++a) {
            const std::optional<std::vector<double>> found = from(a);
            for (std::size_t b = 0; found && b < truth_.size(); ++b) {
                if (ignores_[b]) {
                    continue;
                }
                const double truth = truth_[a][b], distance = (*found)[b];
                const bool is_long = truth < reach_ - error && !(distance <= truth + error);
                if (is_long || distance < truth - error) {
                    wrong_.push_back({kind, a, b, distance, truth});
                }
            }
        }
    }

    /// Adds true distances that are not equal both ways.
    void add_one_way() {
        for (std::size_t a = 0; a < truth_.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const double there = truth_[a][b], back = truth_[b][a];
                if (std::min(there, back) <= reach_ && !(std::abs(there - back) < 1e-11 * reach_)) {
                    wrong_.push_back({"unfolding, back", b, a, back, there});
                }
            }
        }
    }

    std::vector<WrongDistance> wrong() && { return std::move(wrong_); }

  private:
    const DistanceTable& truth_;
    double reach_;
    std::vector<bool> ignores_;
    std::vector<WrongDistance> wrong_;
};

} // namespace

DistanceTable unfolded_distances(const TestMesh& mesh, const std::vector<Point>& points,
                                 double reach) {
    const Unfolding unfolding(mesh);
    DistanceTable table;
    for (const Point& source : points) {
        table.push_back(unfolding.distances(source, points, 1.01 * reach));
    }
    return table;
}

std::string WrongDistance::text() const {
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, "%.17g in place of %.17g", found, truth);
    return std::string(kind) + ": from point " + std::to_string(from) + " to point " +
           std::to_string(to) + ' ' + numbers;
}

std::vector<WrongDistance> wrong_distances(const TestMesh& mesh, const PreparedMesh& surface,
                                           const std::vector<Point>& points, double reach) {
    const DistanceTable truth = unfolded_distances(mesh, points, reach);
    const ref::Tolerances tolerances = ref::frame_of(surface, reach).tolerances();
    GeodesicQuery<double> exact(surface, reach, points, ref::double_tolerances());
    GeodesicQuery<float> twin(surface, reach, points, tolerances);
    GeodesicQuery<float> trimming(surface, reach, points, tolerances);
    trimming.trim_all();
    const double guard = tolerances.guard * reach;
    const auto all_from = [&](auto& query) {
        return [&](std::size_t a) { return std::optional(query.from(points[a])); };
    };
    std::vector<bool> ignores;
    for (const Point& point : points) {
        ignores.push_back(is_below_resolution(surface, point.face, reach));
    }
    Comparison comparison(truth, reach, std::move(ignores));
    comparison.add_one_way();
    comparison.add("double", 2e-7 * reach, all_from(exact));
    comparison.add("library", 1e-9 * reach, [&](std::size_t a) {
        return library_distances(surface, reach, points[a], points);
    });
    comparison.add("float", guard, all_from(twin));
    comparison.add("float, trimming", guard, all_from(trimming));
    comparison.add("float, by a group", guard,
                   [&](std::size_t a) { return twin.by_group_from(points[a]); });
    return std::move(comparison).wrong();
}

} // namespace geodisk::test
