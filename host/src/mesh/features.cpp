#include "geodisk/features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

using Vector = std::array<double, 8>;

constexpr double kSharpTurn = 45;
// Tolerance of cosines: angles that equal a bound are not above it.
constexpr double kCosineTolerance = 1e-9;

double cosine_of(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180) - kCosineTolerance;
}

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        sum += a[axis] * b[axis];
    }
    return sum;
}

Vector sum_of(const Vector& a, double factor, const Vector& b) {
    Vector sum{};
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        sum[axis] = a[axis] + factor * b[axis];
    }
    return sum;
}

/// Returns the vector with length 1; 0 if it has no length.
Vector unit(const Vector& v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0 ? sum_of(Vector{}, 1 / length, v) : Vector{};
}

class Finder {
  public:
    Finder(const MeshView& view, const PreparedMesh& mesh, double degrees)
        : view_(view), mesh_(mesh), flat_(cosine_of(degrees)) {}

    bool is_feature(std::uint32_t h) const {
        const auto edges = mesh_.half_edges();
        const std::uint32_t other = around_half_edge(edges[h].around);
        if (other == h || around_half_edge(edges[other].around) != h) {
            return true;
        }
        const Vector one = height(h), two = height(other);
        // No angle is known where a face has no area.
        return dot(one, one) > 0 && dot(two, two) > 0 && -dot(one, two) < flat_;
    }

    /// Returns true for the lowest half-edge of an edge with a length.
    bool is_lowest(std::uint32_t h) const {
        const auto edges = mesh_.half_edges();
        if (!takes_part(h / 3) || !(edges[h].length > 0)) {
            return false;
        }
        std::uint32_t other = around_half_edge(edges[h].around);
        while (other > h) {
            other = around_half_edge(edges[other].around);
        }
        return other == h;
    }

    std::vector<std::uint32_t> corners_of(std::span<const std::uint32_t> curve_edges) const {
        struct End {
            std::uint32_t vertex, half_edge;
        };
        std::vector<End> ends;
        const auto edges = mesh_.half_edges();
        for (const std::uint32_t h : curve_edges) {
            ends.push_back({edges[h].origin, h});
            ends.push_back({edges[next_in_face(h)].origin, h});
        }
        std::ranges::stable_sort(ends, {}, &End::vertex);
        const double sharp = cosine_of(kSharpTurn);
        std::vector<std::uint32_t> corners;
        for (std::size_t first = 0, end = 0; first < ends.size(); first = end) {
            const std::uint32_t vertex = ends[first].vertex;
            while (end < ends.size() && ends[end].vertex == vertex) {
                ++end;
            }
            const bool goes_on =
                end - first == 2 && -dot(way_from(vertex, ends[first].half_edge),
                                         way_from(vertex, ends[first + 1].half_edge)) >= sharp;
            if (!goes_on) {
                corners.push_back(vertex);
            }
        }
        return corners;
    }

  private:
    bool takes_part(std::uint32_t face) const {
        const auto edges = mesh_.half_edges().subspan(std::size_t{3} * face, 3);
        return edges[0].origin != edges[1].origin && edges[1].origin != edges[2].origin &&
               edges[2].origin != edges[0].origin;
    }

    Vector position(std::uint32_t corner) const {
        Vector at{};
        for (std::size_t axis = 0; axis < view_.dimension; ++axis) {
            at[axis] = view_.coordinate(view_.triangles[corner], axis);
        }
        return at;
    }

    /// Returns the direction from the half-edge into its face, at a right angle.
    Vector height(std::uint32_t h) const {
        const Vector start = position(h);
        const Vector along = unit(sum_of(position(next_in_face(h)), -1, start));
        const Vector to_apex = unit(sum_of(position(previous_in_face(h)), -1, start));
        return unit(sum_of(to_apex, -dot(to_apex, along), along));
    }

    /// Returns the direction of an edge, away from one of its ends.
    Vector way_from(std::uint32_t vertex, std::uint32_t h) const {
        const Vector along = unit(sum_of(position(next_in_face(h)), -1, position(h)));
        return mesh_.half_edges()[h].origin == vertex ? along : sum_of(Vector{}, -1, along);
    }

    const MeshView& view_;
    const PreparedMesh& mesh_;
    double flat_;
};

} // namespace

Result<Features> Features::find(const MeshView& view, const PreparedMesh& mesh,
                                double degrees) noexcept {
    return guarded([&]() -> Result<Features> {
        if (!(degrees >= 1 && degrees <= 180)) {
            return invalid("the angle of features is " + number_text(degrees) +
                           " degrees, not from 1 to 180");
        }
        if (view.face_count() != mesh.face_count() || view.vertex_count() != mesh.vertex_count()) {
            return invalid("the view is not of the mesh that was prepared");
        }
        const Finder finder(view, mesh, degrees);
        Features features;
        for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
            if (finder.is_lowest(h) && finder.is_feature(h)) {
                features.edges_.push_back(h);
                features.length_ += mesh.half_edges()[h].length;
            }
        }
        features.corners_ = finder.corners_of(features.edges_);
        features.mesh_ = mesh.identity();
        return features;
    });
}

} // namespace geodisk
