#include "support/geodesic_query.hpp"

#include <algorithm>
#include <utility>

namespace geodisk::test {
namespace {

template <class Real>
ref::FacePoint<Real> converted(const Point& p) {
    return {p.face, static_cast<Real>(p.weight1), static_cast<Real>(p.weight2)};
}

template <class Real>
std::vector<ref::FacePoint<Real>> converted(const std::vector<Point>& points) {
    std::vector<ref::FacePoint<Real>> result;
    result.reserve(points.size());
    for (const Point& p : points) {
        result.push_back(converted<Real>(p));
    }
    return result;
}

} // namespace

ref::Tolerances tight_tolerances() {
    ref::Tolerances t{};
    t.limit = 1;
    t.margin = 0x1p-30f;
    t.slack = 0x1p-30f;
    return t;
}

template <class Real>
GeodesicQuery<Real>::GeodesicQuery(PreparedMesh mesh, double reach,
                                   const std::vector<Point>& targets,
                                   const ref::Tolerances& tolerances)
    : mesh_(std::move(mesh)), surface_(mesh_, reach), bins_(surface_, converted<Real>(targets)),
      detector_(surface_, bins_, tolerances, tolerances.limit),
      group_(surface_, bins_, tolerances, tolerances.limit) {}

template <class Real>
template <class Detector>
std::vector<double> GeodesicQuery<Real>::from_by(Detector& detector, const Point& source) {
    std::vector<double> result(bins_.order.size(), kUnreachable);
    count_ = detector.run(
        converted<Real>(source), [](std::uint32_t) { return true; },
        [&](std::uint32_t place, Real distance) {
            double& best = result[bins_.order[place]];
            best = std::min(best, static_cast<double>(distance) * surface_.frame.unit);
        });
    return result;
}

template <class Real>
std::vector<double> GeodesicQuery<Real>::from(const Point& source) {
    return from_by(detector_, source);
}

template <class Real>
std::optional<std::vector<double>> GeodesicQuery<Real>::by_group_from(const Point& source) {
    try {
        return from_by(group_, source);
    } catch (const ref::ManyWindows&) {
        return std::nullopt;
    }
}

template class GeodesicQuery<float>;
template class GeodesicQuery<double>;

} // namespace geodisk::test
