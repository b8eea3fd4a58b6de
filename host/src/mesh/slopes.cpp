#include "mesh/slopes.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace geodisk {
namespace {

// Target for gradients of more than 1. A little lower than necessary, so that vertices that raise
// each other in turn converge.
constexpr double kTarget = 0.95;
// A face of lower height, in units of the distance, gets a single value: small steps would take too
// long.
constexpr double kNarrow = 0x1p-12;

/// Values at the vertices of a mesh, raised until no face has a gradient of more than 1.
class Slopes {
  public:
    Slopes(const PreparedMesh& mesh, double unit, std::vector<double>& values)
        : mesh_(mesh), unit_(unit), values_(values) {}

    void raise_all() {
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            relax(f);
        }
        raise_more([](std::uint32_t) {});
    }

    void raise_some(std::span<const std::uint32_t> faces, std::vector<std::uint32_t>& raised) {
        for (const std::uint32_t face : faces) {
            relax(face);
        }
        raise_more([&](std::uint32_t vertex) { raised.push_back(vertex); });
    }

  private:
    /// Calls `note` with each vertex that was raised.
    template <class Note>
    void raise_more(const Note& note) {
        // Highest vertex first: vertices that it raises rarely need to be raised again.
        while (!raised_.empty()) {
            const auto [value, vertex] = raised_.top();
            raised_.pop();
            if (value < values_[vertex]) {
                continue;
            }
            note(vertex);
            const VertexFan& fan = mesh_.fans()[vertex];
            for (const std::uint32_t corner :
                 mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
                relax(corner / 3);
            }
        }
    }

    double length(std::uint32_t h) const { return mesh_.half_edges()[h].length / unit_; }
    double& start(std::uint32_t h) { return values_[mesh_.half_edges()[h].origin]; }
    double& end(std::uint32_t h) { return start(next_in_face(h)); }
    double& apex(std::uint32_t h) { return start(previous_in_face(h)); }

    void raise(std::uint32_t h, double value) {
        start(h) = value;
        raised_.emplace(value, mesh_.half_edges()[h].origin);
    }

    /// Returns the smallest value at the apex over h that leaves this part of what the gradient
    /// across h may be, beside the gradient along h.
    double min_at_apex(std::uint32_t h, double part) {
        const HalfEdge& edge = mesh_.half_edges()[h];
        const double along = edge.length > 0 ? (end(h) - start(h)) / length(h) : 0;
        const double across = part * std::sqrt(std::max(0.0, 1 - along * along));
        return start(h) + along * (edge.apex_x / unit_) - across * (edge.apex_y / unit_);
    }

    /// Raises the vertices of a face that are too low; one step.
    void relax(std::uint32_t face) {
        const std::uint32_t first = 3 * face;
        const double longest = std::max({length(first), length(first + 1), length(first + 2)});
        if (!(longest > 0)) {
            return; // The face is ignored.
        }
        const double highest = std::max({start(first), end(first), apex(first)});
        const double area = length(first) * mesh_.half_edges()[first].apex_y / unit_;
        const bool narrow = area < kNarrow * longest;
        for (std::uint32_t h = first; h < first + 3; ++h) {
            const std::uint32_t low = start(h) < end(h) ? h : next_in_face(h);
            const double top = std::max(start(h), end(h));
            if (top - start(low) > length(h)) {
                raise(low, narrow ? highest : top - kTarget * length(h));
            }
        }
        for (std::uint32_t h = first; h < first + 3; ++h) {
            if (apex(h) < highest && apex(h) < min_at_apex(h, 1)) {
                raise(previous_in_face(h),
                      narrow ? highest : std::min(highest, min_at_apex(h, kTarget)));
            }
        }
    }

    const PreparedMesh& mesh_;
    double unit_;
    std::vector<double>& values_; ///< Values in units of the distance.
    std::priority_queue<std::pair<double, std::uint32_t>> raised_;
};

} // namespace

std::vector<double> raised_to_slope(const PreparedMesh& mesh, double unit,
                                    std::vector<double> values) {
    Slopes(mesh, unit, values).raise_all();
    return values;
}

void raise_to_slope(const PreparedMesh& mesh, double unit, std::span<const std::uint32_t> faces,
                    std::vector<double>& values, std::vector<std::uint32_t>& raised) {
    Slopes(mesh, unit, values).raise_some(faces, raised);
}

} // namespace geodisk
