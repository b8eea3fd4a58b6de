#include "lib/surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/scalar.hpp"

namespace geodisk::ref {

namespace {

/// Returns true if the candidates of a job have 24 others or fewer in their face, in the mean.
bool has_small_faces(const PreparedMesh& mesh, const SampleParams& params, const Frame& frame) {
    constexpr double kFew = 24;
    const auto weight_of = [&](std::uint32_t face) {
        const double density = params.radii != nullptr ? params.radii->densities()[face]
                                                       : candidates_of_classes(params);
        return takes_samples(params, face) ? area_of(mesh, face) * density : 0;
    };
    double sum = 0, squares = 0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const double weight = weight_of(face);
        sum += weight;
        squares += weight * weight;
    }
    const std::uint32_t darts = frame.stages.darts;
    const double candidates = darts != 0 ? darts : frame.stages.ratio * frame.samples_on(sum);
    return squares / sum * (candidates / sum) <= kFew;
}

} // namespace

template <class Real>
Surface<Real>::Surface(const PreparedMesh& mesh, double min_distance)
    : Surface(mesh, ref::frame_of(mesh, min_distance)) {}

template <class Real>
Surface<Real>::Surface(const PreparedMesh& mesh, const Frame& frame_of_whole)
    : frame(frame_of_whole), fans(mesh.fans()), corners(mesh.corners()) {
    place_edges(mesh);
}

template <class Real>
Surface<Real>::Surface(const PreparedMesh& mesh, const SampleParams& params)
    : Surface(mesh, params, ref::frame_of(mesh, params)) {}

template <class Real>
Surface<Real>::Surface(const PreparedMesh& mesh, const SampleParams& params,
                       const Frame& frame_of_whole)
    : frame(frame_of_whole), fans(mesh.fans()), corners(mesh.corners()),
      one_cell_each(has_small_faces(mesh, params, frame)) {
    place_edges(mesh);
    set_classes(params.class_factors);
    for (const double share : params.class_shares) {
        classes.shares.push_back(
            share > 0 ? static_cast<float>(std::max(std::round(share * 512), 1.0) / 512) : 0);
    }
    if (params.radii == nullptr) {
        return;
    }
    const auto bounds = params.radii->reach_bounds(mesh, params.min_distance);
    if (!bounds) {
        throw std::runtime_error(bounds.error().message);
    }
    for (std::uint32_t f = 0; f < face_count(); ++f) {
        FaceRadii<Real>& face = radii.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t h = std::size_t{3} * f + k;
            face.corner[k] = params.radii->packing().empty()
                                 ? static_cast<Real>(params.radii->factors()[h]) / 2
                                 : -static_cast<Real>(params.radii->packing()[h]);
            face.spread[k] = params.radii->spreads()[h];
        }
        face.bound = static_cast<Real>((*bounds)[f]);
    }
}

template <class Real>
void Surface<Real>::set_classes(std::span<const float> factors) {
    classes.count = static_cast<std::uint32_t>(std::lround(std::sqrt(double(factors.size()))));
    double all = 0;
    double shares[8]{};
    for (std::uint32_t a = 0; a < classes.count; ++a) {
        for (std::uint32_t b = 0; b < classes.count; ++b) {
            classes.distance[a][b] = static_cast<Real>(factors[classes.count * a + b]);
            classes.reach[a] = std::max(classes.reach[a], classes.distance[a][b]);
        }
        const double own = factors[(classes.count + 1) * a];
        all += shares[a] = 1 / (own * own);
    }
    double sum = 0;
    for (std::uint32_t a = 0; a < classes.count; ++a) {
        sum += shares[a];
        classes.turns[a] = static_cast<std::uint64_t>(
            std::ldexp(shares[a] / *std::max_element(shares, shares + 8), 31));
        classes.ends[a] = static_cast<std::uint64_t>(std::ldexp(sum / all, 32));
    }
}

template <class Real>
Real Surface<Real>::radius_at(FacePoint<Real> point) const {
    const Real(&r)[3] = radii[point.face].corner;
    return FaceRadii<Real>::radius_of((Real{1} - point.weight1 - point.weight2) * r[0] +
                                      point.weight1 * r[1] + point.weight2 * r[2]);
}

template <class Real>
void Surface<Real>::place_edges(const PreparedMesh& mesh) {
    edges.reserve(mesh.half_edges().size());
    const auto scaled = [this](double length) {
        const double x = length / frame.unit;
        return static_cast<Real>(x < kSmallestOffset && x > -kSmallestOffset ? 0.0 : x);
    };
    const auto direction = [](double x) {
        return static_cast<Real>(x < kSmallestOffset && x > -kSmallestOffset ? 0.0 : x);
    };
    for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
        const HalfEdge& e = mesh.half_edges()[h];
        const Real previous = scaled(mesh.half_edges()[geodisk::previous_in_face(h)].length);
        const Direction angle = e.angle();
        const Real cosine = direction(angle.cosine);
        const Real sine = direction(angle.sine);
        edges.push_back({scaled(e.length), previous * cosine, previous * sine, cosine, sine,
                         e.origin, e.around, e.fan_angles});
    }
}

template struct Surface<float>;
template struct Surface<double>;

namespace {

/// Cells of the grids of all faces when lengths are in units of `unit`.
double cell_count(const PreparedMesh& mesh, double unit) {
    const double cells_per_length = gpu::kCellsPerDistance / unit;
    double total = 0;
    for (std::size_t h = 0; h < mesh.half_edges().size(); h += 3) {
        double longest = 0;
        double height = 0;
        for (std::size_t side = h; side < h + 3; ++side) {
            const HalfEdge& edge = mesh.half_edges()[side];
            if (edge.length > longest) {
                longest = edge.length;
                height = edge.apex_y;
            }
        }
        total +=
            std::floor(longest * cells_per_length + 1) * std::floor(height * cells_per_length + 1);
    }
    return total;
}

} // namespace

double suitable_unit(const PreparedMesh& mesh, double distance, double max_cells) {
    const double extent = std::max(mesh.statistics().diagonal, mesh.statistics().longest_edge);
    double unit = std::min(distance, extent);
    // A cell for each face at least.
    const double most = std::max(max_cells, 2.0 * static_cast<double>(mesh.half_edges().size()));
    while (cell_count(mesh, unit) > most) {
        unit *= 2;
    }
    return unit;
}

double longest_path(const PreparedMesh& mesh) {
    double length = 0;
    for (const HalfEdge& edge : mesh.half_edges()) {
        length += edge.length;
    }
    return length;
}

} // namespace geodisk::ref
