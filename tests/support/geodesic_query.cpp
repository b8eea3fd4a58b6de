#include "support/geodesic_query.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

#include <geodisk/geodesics.hpp>

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

Sample sample_at(const Point& point) {
    return {point.face,
            {static_cast<float>(1 - point.weight1 - point.weight2),
             static_cast<float>(point.weight1), static_cast<float>(point.weight2)}};
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

std::optional<std::vector<double>> library_distances(const PreparedMesh& mesh, double reach,
                                                     const Point& source,
                                                     const std::vector<Point>& targets) {
    const Sample from = sample_at(source);
    std::vector<Sample> to;
    std::ranges::transform(targets, std::back_inserter(to), sample_at);
    DistanceQuery query;
    query.sources = std::span(&from, 1);
    query.targets = to;
    query.within = reach;
    auto found = geodesic_distances(mesh, query);
    if (!found && found.error().status != Status::mesh_rejected) {
        throw std::runtime_error(found.error().message);
    }
    if (!found) {
        return std::nullopt;
    }
    return std::move(found->distances);
}

template class GeodesicQuery<float>;
template class GeodesicQuery<double>;

} // namespace geodisk::test
