#include "mesh/face_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "mesh/vertex_fans.hpp"
#include "support/blocks.hpp"
#include "support/prefetch.hpp"

namespace geodisk {
namespace {

using Face = std::array<std::uint32_t, 3>;

/// Coordinates of a vertex, padded with zeros, which add nothing to sums.
template <std::size_t kAxes>
using Vertex = std::array<double, kAxes>;

/// Reads vertices of a view whose coordinates have this type.
template <class Coordinate>
class Vertices {
  public:
    explicit Vertices(const MeshView& mesh)
        : first_(static_cast<const std::byte*>(mesh.positions.data())),
          stride_(mesh.positions.stride(mesh.dimension)), dimension_(mesh.dimension) {}

    const Coordinate* operator[](std::uint32_t v) const {
        return reinterpret_cast<const Coordinate*>(first_ + v * stride_);
    }
    template <std::size_t kAxes>
    Vertex<kAxes> load(std::uint32_t v) const {
        Vertex<kAxes> vertex{};
        if (dimension_ == kAxes) {
            std::copy_n((*this)[v], kAxes, vertex.begin()); // A constant count needs no loop.
        } else {
            std::copy_n((*this)[v], dimension_, vertex.begin());
        }
        return vertex;
    }

  private:
    const std::byte* first_;
    std::size_t stride_;
    std::uint32_t dimension_;
};

template <std::size_t kAxes>
double distance(const Vertex<kAxes>& a, const Vertex<kAxes>& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const double d = b[axis] - a[axis];
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// Returns the apex of a face in the frame of its edge from a to b. Orthogonal rejection keeps the
/// height of a needle, where Heron's formula would lose it.
template <std::size_t kAxes>
void place_apex(const Vertex<kAxes>& a, const Vertex<kAxes>& b, const Vertex<kAxes>& c,
                HalfEdge& edge) {
    if (edge.length == 0) {
        edge.apex_x = 0;
        edge.apex_y = distance(a, c);
        return;
    }
    double dot = 0;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        dot += (c[axis] - a[axis]) * (b[axis] - a[axis]);
    }
    edge.apex_x = dot / edge.length;
    const double part = dot / (edge.length * edge.length);
    double height2 = 0;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const double along = (b[axis] - a[axis]) * part;
        const double d = c[axis] - a[axis] - along;
        height2 += d * d;
    }
    edge.apex_y = std::sqrt(height2);
}

template <std::size_t kAxes>
void place_face(const Vertex<kAxes> (&corners)[3], HalfEdge (&edges)[3]) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Vertex<kAxes>& a = corners[k];
        const Vertex<kAxes>& b = corners[(k + 1) % 3];
        edges[k].length = distance(a, b);
        place_apex(a, b, corners[(k + 2) % 3], edges[k]);
    }
}

/// Fills in all faces block by block; `place(f, face, edges)` computes the edges.
template <typename Place>
void place_all(const ThreadOptions& threads, const IndexView& triangles,
               UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
               MeshStatistics& statistics, const Place& place) {
    const std::size_t faces = triangles.size() / 3;
    half_edges.resize(triangles.size());
    links.resize(triangles.size());
    UninitializedVector<double> areas(faces);
    std::vector<MeshStatistics> blocks(block_count(faces));
    for_blocks(threads, faces, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto face = triangles.face(f);
            HalfEdge edges[3]{};
            std::uint32_t angles[3]{};
            if (takes_part(face)) {
                place(f, face, edges);
                for (std::uint32_t k = 0; k < 3; ++k) {
                    angles[k] = pack_corner_angle(edges[k], edges[previous_in_face(k)]);
                }
            }
            areas[f] = add_face(takes_part(face), edges, blocks[begin / kBlock]);
            const auto first = static_cast<std::uint32_t>(3 * f);
            for (std::uint32_t k = 0; k < 3; ++k) {
                edges[k].origin = face[k];
                links[first + k] = {face[k], lone_half_edge(first + k), angles[k]};
            }
            std::copy_n(edges, 3, half_edges.begin() + first);
        }
    });
    sum_up(areas, blocks, statistics);
}

template <std::size_t kAxes, class Coordinate>
void place_vertices(const ThreadOptions& threads, const MeshView& mesh,
                    UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                    MeshStatistics& statistics) {
    const std::size_t faces = mesh.face_count();
    const Vertices<Coordinate> vertices(mesh);
    constexpr std::size_t kAhead = 8; // Number of faces that take about as long as a memory access.
    place_all(threads, mesh.triangles, half_edges, links, statistics,
              [&](std::size_t f, const Face& face, HalfEdge(&edges)[3]) {
                  if (f + kAhead < faces) {
                      for (const std::uint32_t v : mesh.triangles.face(f + kAhead)) {
                          prefetch(vertices[v]);
                      }
                  }
                  const Vertex<kAxes> corners[3] = {vertices.template load<kAxes>(face[0]),
                                                    vertices.template load<kAxes>(face[1]),
                                                    vertices.template load<kAxes>(face[2])};
                  place_face(corners, edges);
              });
}

template <std::size_t kAxes>
void place_coordinates(const ThreadOptions& threads, const MeshView& mesh,
                       UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                       MeshStatistics& statistics) {
    mesh.positions.is_float()
        ? place_vertices<kAxes, float>(threads, mesh, half_edges, links, statistics)
        : place_vertices<kAxes, double>(threads, mesh, half_edges, links, statistics);
}

/// Returns twice the area of a triangle with these sides; 0 if they only just reach each other or,
/// by rounding, do not (Kahan 2000). Computes in units of the longest side, so that no product
/// overflows.
double double_area(double a, double b, double c) {
    if (a < b) {
        std::swap(a, b);
    }
    if (b < c) {
        std::swap(b, c);
    }
    if (a < b) {
        std::swap(a, b);
    }
    const double y = b / a, z = c / a;
    const double slack = z - (1 - y);
    return slack > 0
               ? 0.5 * std::sqrt((1 + (y + z)) * slack * (z + (1 - y)) * (1 + (y - z))) * a * a
               : 0;
}

/// Computes the apex of a face from the lengths of the next and previous edges.
void place_apex(double next, double previous, double twice_area, HalfEdge& edge) {
    const double length = edge.length;
    if (twice_area > 0) {
        edge.apex_x = 0.5 * (length + (previous - next) / length * (previous + next));
        edge.apex_y = twice_area / length;
    } else {
        // A flat face: the apex lies on the line of the edge, before its origin if the next edge
        // spans the other two.
        edge.apex_x = next > length && next > previous ? -previous : previous;
        edge.apex_y = 0;
    }
}

} // namespace

Direction HalfEdge::angle() const noexcept {
    // Not std::hypot, whose last bit differs between C libraries.
    const double left = std::sqrt(apex_x * apex_x + apex_y * apex_y);
    return left > 0 ? Direction{apex_x / left, apex_y / left} : Direction{1, 0};
}

double add_face(bool takes_part, const HalfEdge (&edges)[3], MeshStatistics& block) {
    if (!takes_part) {
        ++block.repeated_index_faces;
        return 0;
    }
    for (const HalfEdge& edge : edges) {
        block.longest_edge = std::max(block.longest_edge, edge.length);
    }
    const double area = 0.5 * edges[0].length * edges[0].apex_y;
    block.zero_area_faces += area == 0;
    return area;
}

void sum_up(std::span<const double> areas, std::span<const MeshStatistics> blocks,
            MeshStatistics& statistics) {
    statistics.triangles = areas.size();
    for (const MeshStatistics& block : blocks) {
        statistics.repeated_index_faces += block.repeated_index_faces;
        statistics.zero_area_faces += block.zero_area_faces;
        statistics.longest_edge = std::max(statistics.longest_edge, block.longest_edge);
    }
    statistics.area = std::accumulate(areas.begin(), areas.end(), 0.0);
}

void place_faces(const ThreadOptions& threads, const MeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics) {
    mesh.dimension <= 3 ? place_coordinates<3>(threads, mesh, half_edges, links, statistics)
                        : place_coordinates<8>(threads, mesh, half_edges, links, statistics);
}

void place_faces(const ThreadOptions& threads, const LengthMeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics) {
    place_all(threads, mesh.triangles, half_edges, links, statistics,
              [&](std::size_t f, const Face&, HalfEdge(&edges)[3]) {
                  const auto lengths = mesh.lengths.subspan(3 * f, 3);
                  const double twice_area = double_area(lengths[0], lengths[1], lengths[2]);
                  for (std::uint32_t k = 0; k < 3; ++k) {
                      edges[k].length = lengths[k];
                      place_apex(lengths[next_in_face(k)], lengths[previous_in_face(k)], twice_area,
                                 edges[k]);
                  }
              });
}

} // namespace geodisk
