#include "ref/dart_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <doctest/doctest.h>

#include "lib/frame.hpp"
#include "support/oracle_geodesic.hpp"
#include "throw_darts.hpp"

namespace geodisk::test {
namespace {

using glm::length;

/// The faces near one point as a mesh of their own, small enough to ask CGAL about each sample.
///
/// It holds every face that meets the ball around the point, so every path shorter than the radius
/// lies within. A vertex that keeps several fans has lost a face and is outside of the ball: it
/// becomes one vertex per fan, because CGAL takes no other.
class Patch {
  public:
    Patch(const TestMesh& mesh, Vec3 center, double radius);

    Point inside(const Point& p) const { return {faces_.at(p.face), p.weight1, p.weight2}; }
    const TestMesh& mesh() const { return patch_; }

  private:
    std::uint32_t fan_of(std::uint32_t corner) {
        while (fans_[corner] != corner) {
            corner = fans_[corner] = fans_[fans_[corner]];
        }
        return corner;
    }
    void join_fans(const std::vector<std::uint32_t>& triangles);

    TestMesh patch_;
    std::map<std::uint32_t, std::uint32_t> faces_; ///< From the mesh's faces to the patch's.
    std::vector<std::uint32_t> fans_;              ///< Per corner another one of its fan.
};

/// Distance from a point to the bounding box of a triangle, at most the one to the triangle.
double distance_to_box(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const auto outside = [](double x, double u, double v, double w) {
        return std::max({std::min({u, v, w}) - x, x - std::max({u, v, w}), 0.0});
    };
    return length(Vec3{outside(p.x, a.x, b.x, c.x), outside(p.y, a.y, b.y, c.y),
                       outside(p.z, a.z, b.z, c.z)});
}

/// Corners at the two ends of an edge belong together in both of its faces.
void Patch::join_fans(const std::vector<std::uint32_t>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> half_edges;
    fans_.resize(triangles.size());
    std::iota(fans_.begin(), fans_.end(), 0u);
    for (std::uint32_t h = 0; h < triangles.size(); ++h) {
        const std::uint32_t a = triangles[h];
        const std::uint32_t b = triangles[next_in_face(h)];
        if (const auto twin = half_edges.find({b, a}); twin != half_edges.end()) {
            fans_[fan_of(h)] = fan_of(next_in_face(twin->second));
            fans_[fan_of(next_in_face(h))] = fan_of(twin->second);
        }
        half_edges[{a, b}] = h;
    }
}

Patch::Patch(const TestMesh& mesh, Vec3 center, double radius) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (distance_to_box(center, mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)) <=
            radius) {
            faces_.emplace(f, static_cast<std::uint32_t>(triangles.size() / 3));
            const auto first = mesh.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(f);
            triangles.insert(triangles.end(), first, first + 3);
        }
    }
    join_fans(triangles);
    std::map<std::uint32_t, std::uint32_t> vertices;
    for (std::uint32_t corner = 0; corner < triangles.size(); ++corner) {
        const auto [at, is_new] = vertices.try_emplace(fan_of(corner), 0u);
        if (is_new) {
            at->second = patch_.add_vertex(mesh.vertex(triangles[corner]));
        }
        patch_.triangles.push_back(at->second);
    }
}

/// The points closer than a radius in space, and their distances along the surface by CGAL: exact
/// where they are below the radius.
struct Nearby {
    std::vector<std::size_t> indices;
    std::vector<double> distances;

    Nearby(const TestMesh& mesh, const Point& source, std::span<const Point> points,
           double radius) {
        const Vec3 center = mesh.position(source);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (length(center - mesh.position(points[i])) < radius) {
                indices.push_back(i);
            }
        }
        if (indices.empty()) {
            return;
        }
        // A little wider than the radius, because CGAL rounds.
        const Patch patch(mesh, center, 1.001 * radius);
        std::vector<Point> targets;
        for (const std::size_t i : indices) {
            targets.push_back(patch.inside(points[i]));
        }
        distances = GeodesicOracle(patch.mesh()).distances(patch.inside(source), targets);
    }
};

template <class Real>
std::vector<Point> points_of(const ref::Pool<Real>& pool) {
    std::vector<Point> result;
    for (const auto& p : pool.by_rank()) {
        result.push_back({p.face, static_cast<double>(p.weight1), static_cast<double>(p.weight2)});
    }
    return result;
}

} // namespace

std::vector<Point> Darts::samples() const {
    std::vector<Point> result;
    for (const std::uint32_t rank : ranks) {
        result.push_back(pool[rank]);
    }
    return result;
}

template <class Real>
Darts thrown(const PreparedMesh& mesh, const SampleParams& params) {
    const ref::Surface<Real> surface(mesh, params);
    const ref::Pool<Real> pool = ref::draw_pool(surface, params);
    Darts darts;
    darts.min_distance = params.min_distance;
    darts.pool = points_of(pool);
    const ref::Frame model = ref::frame_of(mesh, params);
    darts.tolerances = model.tolerances();
    ref::RunResult run =
        ref::throw_darts(surface, pool, darts.tolerances,
                         params.stop_count != 0 ? params.stop_count : kMaxCandidates);
    darts.ranks = std::move(run.ranks);
    darts.largest_error = std::max(model.first_error(), model.error_of(run.longest_chain));
    return darts;
}

template Darts thrown<float>(const PreparedMesh&, const SampleParams&);
template Darts thrown<double>(const PreparedMesh&, const SampleParams&);

SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.statistics().area, count);
    params.seed = seed;
    return params;
}

void check_spacing(const TestMesh& mesh, const std::vector<Point>& samples, double min_distance) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const Nearby near(mesh, samples[i], std::span(samples).subspan(i + 1), min_distance);
        for (const double distance : near.distances) {
            smallest = std::min(smallest, distance);
        }
    }
    CHECK_MESSAGE(smallest >= min_distance, "samples only ", smallest / min_distance, " apart");
}

void check_covered(const TestMesh& mesh, const Darts& darts) {
    const double limit = darts.tolerances.limit + darts.largest_error;
    std::vector<bool> covered(darts.pool.size(), false);
    for (const std::uint32_t rank : darts.ranks) {
        covered[rank] = true;
        const Nearby near(mesh, darts.pool[rank], std::span(darts.pool).subspan(rank + 1),
                          limit * darts.min_distance);
        for (std::size_t i = 0; i < near.distances.size(); ++i) {
            if (near.distances[i] < limit * darts.min_distance) {
                covered[rank + 1 + near.indices[i]] = true;
            }
        }
    }
    const auto free = std::count(covered.begin(), covered.end(), false);
    CHECK_MESSAGE(free == 0, free, " rejected candidates are free");
}

void check_maximal(const PreparedMesh& mesh, const Darts& darts) {
    const ref::Surface<double> surface(mesh, darts.min_distance);
    const ref::Bins<double> bins(surface, darts.pool);
    const double guard = darts.largest_error;
    const double limit = darts.tolerances.limit + guard;
    ref::Detector<double> detector(surface, bins, darts.tolerances, limit);
    std::vector<bool> covered(darts.pool.size(), false);
    double closest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t rank : darts.ranks) {
        std::vector<std::pair<std::uint32_t, double>> hits;
        detector.run(
            darts.pool[rank], [&](std::uint32_t place) { return bins.order[place] > rank; },
            [&](std::uint32_t place, double d) { hits.emplace_back(bins.order[place], d); });
        for (const auto& [other, distance] : hits) {
            covered[other] = true;
            if (std::binary_search(darts.ranks.begin(), darts.ranks.end(), other)) {
                closest = std::min(closest, distance);
            }
        }
    }
    CHECK_MESSAGE(closest >= darts.tolerances.limit - guard, "samples only ", closest, " apart");
    std::uint32_t wrong = 0;
    for (std::uint32_t rank = 0; rank < darts.pool.size(); ++rank) {
        const bool accepted = std::binary_search(darts.ranks.begin(), darts.ranks.end(), rank);
        wrong += !accepted && !covered[rank] ? 1u : 0u;
    }
    CHECK_MESSAGE(wrong == 0, wrong, " rejected candidates are free");
}

} // namespace geodisk::test
