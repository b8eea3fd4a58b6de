#include <geodisk/geodesics.hpp>

#include <algorithm>
#include <array>

#include "engine/neighbours/check_query.hpp"
#include "geodesics/face_frame.hpp"
#include "geodesics/wavefront.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using namespace geodesics;

/// Returns the point of an edge that lies so far from the begin of h.
PathPoint point_on(const PreparedMesh& mesh, std::uint32_t h, double at) {
    const double length = mesh.half_edges()[h].length;
    const double part = length > 0 ? std::clamp(at / length, 0.0, 1.0) : 0;
    PathPoint point{h / 3, {}};
    point.weights[h % 3] = 1 - part;
    point.weights[next_in_face(h) % 3] = part;
    return point;
}

PathPoint point_at(const PreparedMesh& mesh, std::uint32_t vertex) {
    return point_on(mesh, mesh.corners()[mesh.fans()[vertex].first_corner], 0);
}

/// Follows paths back along the windows of a wavefront.
class Backtrack {
  public:
    Backtrack(const PreparedMesh& mesh, const Wavefront& front)
        : mesh_(mesh), edges_(mesh.half_edges()), front_(front) {}

    /// Appends where the last straight part of a path crosses edges, from its end to its root.
    /// `at` is its end, in the frame of Arrival::half_edge.
    void follow(const Arrival& path, FlatPoint at, std::vector<PathPoint>& points) const {
        FlatPoint root{path.x, -path.y};
        std::uint32_t h = path.half_edge;
        for (std::uint32_t trail = path.trail; trail != kNone;) {
            const double length = edges_[h].length;
            const double over = at.y - root.y;
            const double crossing = std::clamp(
                over > 0 ? root.x - root.y * ((at.x - root.x) / over) : at.x, 0.0, length);
            points.push_back(point_on(mesh_, h, crossing));
            const Trail& step = front_.trails()[trail];
            trail = step.from;
            if (trail != kNone) {
                // Into the face that the window came through.
                const bool same_way = edges_[h].origin == edges_[step.half_edge].origin;
                at = {same_way ? crossing : length - crossing, 0};
                root = {same_way ? root.x : length - root.x, -root.y};
                h = step.half_edge;
                const std::uint32_t entered =
                    entered_by(front_.trails()[trail].half_edge, step.half_edge / 3);
                for (; h != entered; h = next_in_face(h)) {
                    at = in_next_frame(edges_, h, at);
                    root = in_next_frame(edges_, h, root);
                }
            }
        }
    }

    /// Does the same for a path to a vertex.
    void follow(const Arrival& path, std::vector<PathPoint>& points) const {
        if (path.half_edge != kNone) {
            const HalfEdge& edge = edges_[path.half_edge];
            follow(path, {edge.apex_x, edge.apex_y}, points);
        }
    }

  private:
    /// Returns the half-edge of a face that is on the same edge as `left`.
    std::uint32_t entered_by(std::uint32_t left, std::uint32_t face) const {
        std::uint32_t h = left;
        do {
            h = around_half_edge(edges_[h].around);
        } while (h / 3 != face);
        return h;
    }

    const PreparedMesh& mesh_;
    std::span<const HalfEdge> edges_;
    const Wavefront& front_;
};

} // namespace

Result<GeodesicPath> geodesic_path(const PreparedMesh& mesh, const Sample& from,
                                   const Sample& to) noexcept {
    return guarded([&]() -> Result<GeodesicPath> {
        const std::array ends{from, to};
        GEODISK_TRY(check_points(mesh, "end", ends));
        const PathPoint begin = precise(from), end = precise(to);
        const std::uint32_t vertex = vertex_at(mesh, end);
        Wavefront front(mesh, kFar);
        if (vertex != kNone) {
            front.aim_at(vertex);
        } else {
            front.aim_at(std::span(&end, 1));
        }
        front.record_trails();
        front.add(begin, 0);
        GEODISK_TRY(front.spread([](std::uint32_t) { return true; }));
        const Arrival* path =
            vertex != kNone ? &front.vertices()[vertex] : &front.targets().front();
        if (path->distance == kFar) {
            return invalid("no path leads from one end to the other");
        }
        const Backtrack backtrack(mesh, front);
        GeodesicPath result{path->distance, {end}};
        if (vertex != kNone) {
            backtrack.follow(*path, result.points);
        } else if (path->half_edge != kNone) {
            backtrack.follow(
                *path, point_in(mesh.half_edges()[path->half_edge], path->half_edge, end.weights),
                result.points);
        }
        while (path->root < mesh.vertex_count() && front.vertices()[path->root].distance > 0) {
            result.points.push_back(point_at(mesh, path->root));
            path = &front.vertices()[path->root];
            backtrack.follow(*path, result.points);
        }
        result.points.push_back(begin);
        std::ranges::reverse(result.points);
        return result;
    });
}

} // namespace geodisk
