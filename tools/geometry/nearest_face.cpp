#include "geometry/nearest_face.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kLeaf = 4; ///< Faces that are not divided further.

Vector operator-(const Vector& a, const Vector& b) {
    Vector difference;
    std::ranges::transform(a, b, difference.begin(), std::minus<>());
    return difference;
}

double dot(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

std::array<double, 3> nearest_weights(const Vector& ab, const Vector& ac, const Vector& to) {
    const double b2 = dot(ab, ab), c2 = dot(ac, ac), bc = dot(ab, ac);
    const double b = dot(to, ab), c = dot(to, ac);
    const double determinant = b2 * c2 - bc * bc;
    if (determinant > 0) {
        const double v = (c2 * b - bc * c) / determinant, w = (b2 * c - bc * b) / determinant;
        if (v >= 0 && w >= 0 && v + w <= 1) {
            return {1 - v - w, v, w};
        }
    }
    const auto along = [](double product, double length2) {
        return length2 > 0 ? std::clamp(product / length2, 0.0, 1.0) : 0.0;
    };
    const Vector side = ac - ab;
    const double t = along(dot(to - ab, side), dot(side, side));
    const double on_ab = along(b, b2), on_ac = along(c, c2);
    std::array<double, 3> best{};
    double least = std::numeric_limits<double>::infinity();
    for (const std::array<double, 3>& weights :
         {std::array{1 - on_ab, on_ab, 0.0}, {1 - on_ac, 0.0, on_ac}, {0.0, 1 - t, t}}) {
        Vector offset = to;
        for (std::size_t axis = 0; axis < offset.size(); ++axis) {
            offset[axis] -= weights[1] * ab[axis] + weights[2] * ac[axis];
        }
        if (const double distance2 = dot(offset, offset); distance2 < least) {
            least = distance2;
            best = weights;
        }
    }
    return best;
}

NearestFace::NearestFace(const MeshFile& mesh) : mesh_(mesh) {
    for (std::uint32_t face = 0; face < mesh.triangle_count(); ++face) {
        if (mesh.takes_part(face)) {
            faces_.push_back(face);
        }
    }
    double largest = 0;
    for (const double x : mesh.positions) {
        largest = std::isfinite(x) ? std::max(largest, std::abs(x)) : largest;
    }
    scale_ = largest > 0 ? 1 / largest : 1;
    build(0, static_cast<std::uint32_t>(faces_.size()));
}

Vector NearestFace::vertex(std::uint32_t face, std::size_t corner) const {
    Vector point{};
    const std::size_t v = mesh_.triangles[std::size_t{3} * face + corner];
    for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
        point[axis] = scale_ * mesh_.positions[v * mesh_.dimension + axis];
    }
    return point;
}

std::uint32_t NearestFace::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node& node = nodes_.emplace_back(
        Node{vertex(faces_[begin], 0), vertex(faces_[begin], 0), begin, end, 0});
    for (std::uint32_t i = begin; i < end; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vector point = vertex(faces_[i], corner);
            for (std::size_t axis = 0; axis < point.size(); ++axis) {
                node.low[axis] = std::min(node.low[axis], point[axis]);
                node.high[axis] = std::max(node.high[axis], point[axis]);
            }
        }
    }
    if (end - begin <= kLeaf) {
        return index;
    }
    const Vector sides = node.high - node.low;
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
    const auto middle_of = [&](std::uint32_t face) {
        return vertex(face, 0)[axis] / 3 + vertex(face, 1)[axis] / 3 + vertex(face, 2)[axis] / 3;
    };
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
                     [&](auto a, auto b) { return middle_of(a) < middle_of(b); });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[index].right = right;
    return index;
}

double NearestFace::distance2_to(const Node& node, const Vector& point) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
        const double outside =
            std::max({node.low[axis] - point[axis], point[axis] - node.high[axis], 0.0});
        sum += outside * outside;
    }
    return sum;
}

void NearestFace::look_at(std::uint32_t face, const Vector& point, SurfacePoint& best) const {
    const Vector a = vertex(face, 0);
    const Vector ab = vertex(face, 1) - a, ac = vertex(face, 2) - a, to = point - a;
    const std::array<double, 3> weights = nearest_weights(ab, ac, to);
    Vector offset = to;
    for (std::size_t axis = 0; axis < offset.size(); ++axis) {
        offset[axis] -= weights[1] * ab[axis] + weights[2] * ac[axis];
    }
    const double distance = std::sqrt(dot(offset, offset));
    if (distance < best.distance || (distance == best.distance && face < best.face)) {
        best = {face, weights, distance};
    }
}

SurfacePoint NearestFace::find(std::span<const double> given) const {
    Vector point{};
    std::ranges::transform(given, point.begin(), [this](double x) { return scale_ * x; });
    SurfacePoint best{0, {}, std::numeric_limits<double>::infinity()};
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const std::uint32_t index = open.back();
        const Node& node = nodes_[index];
        open.pop_back();
        if (distance2_to(node, point) > best.distance * best.distance) {
            continue;
        }
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                look_at(faces_[i], point, best);
            }
            continue;
        }
        const bool is_left_nearer =
            distance2_to(nodes_[index + 1], point) <= distance2_to(nodes_[node.right], point);
        open.push_back(is_left_nearer ? node.right : index + 1);
        open.push_back(is_left_nearer ? index + 1 : node.right); // Which comes first.
    }
    best.distance /= scale_;
    return best;
}

double NearestFace::diagonal() const {
    const Vector sides = nodes_[0].high - nodes_[0].low;
    return std::sqrt(dot(sides, sides)) / scale_;
}

} // namespace geodisk::tools
