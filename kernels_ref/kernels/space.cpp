#include "kernels/space.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/curve.hpp"
#include "kernels/pool.hpp"

namespace geodisk::ref {

namespace {

using Vector = std::array<double, 3>;

std::vector<std::array<float, 3>> vertex_normals(const MeshView& view) {
    std::vector<Vector> sums(view.vertex_count(), Vector{});
    for (std::size_t face = 0; face < view.face_count(); ++face) {
        const auto corner = [&](std::size_t k, std::size_t axis) {
            return view.coordinate(view.triangles[3 * face + k], axis);
        };
        Vector normal;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
            normal[axis] = (corner(1, a) - corner(0, a)) * (corner(2, b) - corner(0, b)) -
                           (corner(1, b) - corner(0, b)) * (corner(2, a) - corner(0, a));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                sums[view.triangles[3 * face + k]][axis] += normal[axis];
            }
        }
    }
    std::vector<std::array<float, 3>> normals(sums.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double length =
            std::sqrt(sums[v][0] * sums[v][0] + sums[v][1] * sums[v][1] + sums[v][2] * sums[v][2]);
        for (std::size_t axis = 0; axis < 3 && length > 0; ++axis) {
            const double part = sums[v][axis] / length;
            normals[v][axis] = static_cast<float>(std::abs(part) < 0x1p-40 ? 0.0 : part);
        }
    }
    return normals;
}

} // namespace

SpacePoints draw_in_space(const MeshView& view, const PreparedMesh& mesh,
                          const SampleParams& params) {
    SpacePoints points;
    points.box.extents.clear();
    points.box.min_distance = params.min_distance;
    points.box.seed = params.seed;
    const Surface<double> surface(mesh, params);
    const auto candidates = draw_pool(surface, params).by_rank();
    points.by_rank.resize(candidates.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto coordinate = [&](std::size_t corner) {
            return view.coordinate(view.triangles[corner], axis);
        };
        double least = coordinate(0);
        double most = least;
        for (std::size_t corner = 1; corner < view.triangles.size(); ++corner) {
            least = std::min(least, coordinate(corner));
            most = std::max(most, coordinate(corner));
        }
        const double side = std::max((most - least) * (1 + 0x1p-30), 0x1p-10 * params.min_distance);
        points.box.extents.push_back(side);
        for (std::size_t rank = 0; rank < candidates.size(); ++rank) {
            const FacePoint<double>& c = candidates[rank];
            const double weights[3] = {1 - c.weight1 - c.weight2, c.weight1, c.weight2};
            std::uint64_t sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double x = coordinate(std::size_t{3} * c.face + k);
                const double corner = std::floor((x - least) / side * 0x1p32);
                sum += static_cast<std::uint64_t>(weights[k] * 0x1p24) *
                       static_cast<std::uint64_t>(corner);
            }
            points.by_rank[rank][axis] = static_cast<std::uint32_t>(sum >> 24);
        }
    }
    const auto normals = vertex_normals(view);
    for (const FacePoint<double>& c : candidates) {
        const auto weight1 = static_cast<float>(c.weight1), weight2 = static_cast<float>(c.weight2);
        const float weight0 = 1.0f - weight1 - weight2;
        std::array<float, 3> sum;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto normal = [&](std::size_t k) {
                return normals[view.triangles[std::size_t{3} * c.face + k]][axis];
            };
            sum[axis] = weight0 * normal(0) + weight1 * normal(1) + weight2 * normal(2);
        }
        const float length = root(product3(sum, sum));
        points.normals.push_back({signed_ratio(sum[0], length), signed_ratio(sum[1], length),
                                  signed_ratio(sum[2], length)});
    }
    const auto& sides = points.box.extents;
    points.guard =
        kBoxGuard + 0x1p-30 * *std::max_element(sides.begin(), sides.end()) / params.min_distance;
    return points;
}

template <class Real>
BoxPool<Real> space_pool(const SpacePoints& points, bool is_curved) {
    BoxPool<Real> pool(BoxLattice::finest(points.box), points.by_rank, points.guard);
    if (is_curved) {
        pool.set_normals(points.normals);
    }
    return pool;
}

template BoxPool<float> space_pool(const SpacePoints&, bool);
template BoxPool<double> space_pool(const SpacePoints&, bool);

} // namespace geodisk::ref
