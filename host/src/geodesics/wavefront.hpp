// Wavefront: windows of straight paths that spread from sources over a surface, nearest first.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "geodesics/face_frame.hpp"
#include "geodesics/window.hpp"
#include "geodesics/window_list.hpp"

namespace geodisk::geodesics {

inline constexpr std::uint32_t kNone = ~std::uint32_t{0};
inline constexpr double kFar = std::numeric_limits<double>::infinity();

/// How the shortest path to a vertex or point ends. It comes straight from a root: a vertex, or the
/// source whose number is the vertex count and its index.
struct Arrival {
    double distance = kFar;
    std::uint32_t root = kNone;
    std::uint32_t source = kNone; ///< Index of the source where the whole path begins.
    /// Half-edge of the last face, by which the path entered it; kNone if the root is in it.
    std::uint32_t half_edge = kNone;
    double x = 0, y = 0; ///< The root is at (x, -y) in its frame.
    std::uint32_t trail = kNone;
};

/// The half-edge by which a window left a face, and the window that it came from; kNone for one
/// whose root is in that face.
struct Trail {
    std::uint32_t half_edge, from;
};

/// Returns the same point, with weights that sum to 1 in double precision.
PathPoint precise(const Sample& point);

/// Returns the vertex that a point is at; kNone if it is at none.
std::uint32_t vertex_at(const PreparedMesh& mesh, const PathPoint& point);

/// Computes exact distances by continuous Dijkstra: the half-edge with the nearest window is next,
/// and all its windows cross the face behind it.
class Wavefront {
  public:
    /// Makes one for a mesh, which must outlive it. Paths longer than `within` are not followed.
    Wavefront(const PreparedMesh& mesh, double within);

    /// Finds the shortest paths to these points too, which must outlive it. With one, it stops
    /// where no path to it can be shorter.
    void aim_at(std::span<const PathPoint> targets);

    /// Stops where no path to this vertex can be shorter.
    void aim_at(std::uint32_t vertex) { aimed_ = vertex; }

    /// Records the trails of windows.
    void record_trails() { records_ = true; }

    /// Adds a source.
    void add(const PathPoint& point, std::uint32_t index);

    /// Spreads the sources. Asks from time to time whether to go on, and tells how many vertices it
    /// reached. Errors: `cancelled` if not; `mesh_rejected` if windows become too many.
    Result<Done> spread(const std::function<bool(std::uint32_t reached)>& goes_on);

    /// Returns the shortest path to each vertex.
    std::span<const Arrival> vertices() const { return vertices_; }
    /// Returns the shortest path to each target.
    std::span<const Arrival> targets() const { return arrivals_; }
    std::span<const Trail> trails() const { return trails_; }

  private:
    struct Next {
        double distance;
        std::uint32_t number; ///< Of a half-edge or vertex.
        bool is_vertex;
        bool operator>(const Next& other) const { return distance > other.distance; }
    };

    std::uint32_t end_of(std::uint32_t h) const { return edges_[next_in_face(h)].origin; }
    double distance_at(std::uint32_t vertex) const { return vertices_[vertex].distance; }

    void begin_in_face(const PathPoint& at, const Arrival& here);
    void reach(std::uint32_t vertex, const Arrival& path);
    void reach_target(std::uint32_t target, const Arrival& path);
    void reach_targets_from(std::uint32_t h, FlatPoint from, const Arrival& root);
    template <class Visit>
    void for_targets_in(std::uint32_t face, const Visit& visit) const;
    void light_fan(std::uint32_t vertex);
    void look(std::uint32_t h, const Window& window);
    void cross_face(std::uint32_t h);
    void cross_to(std::uint32_t child, std::uint32_t h, const Window& window, double near,
                  double far);
    void leave(std::uint32_t h, Window window, std::uint32_t from, WindowList& windows);
    bool is_beaten(std::uint32_t vertex, double way, const Window& window, double at) const;
    bool is_beaten_at_ends(std::uint32_t h, const Window& window) const;
    void arrive(std::uint32_t leaving, WindowList& windows);

    const PreparedMesh& mesh_;
    std::span<const HalfEdge> edges_;
    double within_;
    bool is_in_space_; ///< So that no way around a face is shorter than through it.
    std::vector<Arrival> vertices_;
    std::vector<WindowList> waiting_; ///< By the half-edge of the face that they enter.
    std::vector<double> nearest_;     ///< Nearest window that came to each half-edge since.
    std::priority_queue<Next, std::vector<Next>, std::greater<>> queue_;
    ListMerger merger_;
    WindowList crossing_, to_left_, to_right_, turned_; ///< Working memory.
    std::uint32_t reached_ = 0;                         ///< Vertices.
    std::uint64_t made_ = 0;                            ///< Windows.

    std::uint32_t aimed_ = kNone; ///< Vertex.
    std::span<const PathPoint> targets_;
    std::vector<std::uint32_t> by_face_; ///< Targets in the order of their faces.
    std::vector<bool> has_targets_;      ///< By face; empty without targets.
    std::vector<Arrival> arrivals_;      ///< Of targets.
    bool records_ = false;
    std::vector<Trail> trails_;
};

} // namespace geodisk::geodesics
