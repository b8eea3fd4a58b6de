#include "lib/surface.hpp"

#include "lib/scalar.hpp"

namespace geodisk::ref {

template <class Real>
Surface<Real>::Surface(const PreparedMesh& mesh, double min_distance)
    : unit(working_distance(mesh, min_distance)), fans(mesh.fans()), corners(mesh.corners()), alias(mesh.alias_columns()),
      splits_once(mesh.statistics().nonmanifold_edges == 0) {
    edges.reserve(mesh.half_edges().size());
    const auto scaled = [this](double length) {
        const double x = length / unit;
        return static_cast<Real>(x < kSmallestOffset && x > -kSmallestOffset ? 0.0 : x);
    };
    for (const HalfEdge& e : mesh.half_edges()) {
        edges.push_back({scaled(e.length), scaled(e.apex_x), scaled(e.apex_y),
                         static_cast<Real>(e.cosine), static_cast<Real>(e.sine), e.origin, e.around,
                         e.fan_angles});
    }
}

template struct Surface<float>;
template struct Surface<double>;

} // namespace geodisk::ref
