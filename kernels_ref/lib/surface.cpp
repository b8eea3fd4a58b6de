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
    const auto direction = [](double x) {
        return static_cast<Real>(x < kSmallestOffset && x > -kSmallestOffset ? 0.0 : x);
    };
    for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
        const HalfEdge& e = mesh.half_edges()[h];
        const Real previous = scaled(mesh.half_edges()[geodisk::previous_in_face(h)].length);
        const Real cosine = direction(e.cosine);
        const Real sine = direction(e.sine);
        edges.push_back({scaled(e.length), previous * cosine, previous * sine, cosine, sine,
                         e.origin, e.around, e.fan_angles});
    }
}

template struct Surface<float>;
template struct Surface<double>;

} // namespace geodisk::ref
