// Locality: the candidates of one face follow from the seed, its key and its shape alone. Parts and
// edits of a mesh leave the candidates of all other faces as they were, and samples that are far
// enough.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "ref/dart_check.hpp"
#include "support/radius_fields.hpp"
#include "throw_darts.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Order word and weights.
using Candidate = std::tuple<std::uint32_t, double, double>;
/// By key.
using LocalFaces = std::map<std::uint32_t, std::vector<Candidate>>;

template <class Real>
LocalFaces faces_of(const PreparedMesh& mesh, const SampleParams& params) {
    const auto pool = ref::draw_pool(ref::Surface<Real>(mesh, params), params);
    LocalFaces faces;
    for (std::uint32_t rank = 0; rank < pool.size(); ++rank) {
        const auto p = pool.candidate(rank);
        const std::uint32_t key = params.face_keys.empty() ? p.face : params.face_keys[p.face];
        faces[key].emplace_back(pool.word(rank), static_cast<double>(p.weight1),
                                static_cast<double>(p.weight2));
    }
    return faces;
}

/// The faces of a mesh in the half space x > 0, in another order, and which they are.
struct LocalPart {
    TestMesh mesh;
    std::vector<std::uint32_t> keys;

    explicit LocalPart(const TestMesh& whole) {
        mesh.positions = whole.positions;
        for (std::uint32_t f = whole.face_count(); f-- > 0;) {
            if (whole.corner(f, 0).x + whole.corner(f, 1).x + whole.corner(f, 2).x > 0) {
                keys.push_back(f);
                const std::uint32_t* const corners = &whole.triangles[std::size_t{3} * f];
                mesh.add_triangle(corners[0], corners[1], corners[2]);
            }
        }
    }
};

template <class Real>
void check_part(const TestMesh& whole, bool has_radii) {
    const LocalPart part(whole);
    const PreparedMesh all = prepared(whole);
    const PreparedMesh some = prepared(part.mesh);
    REQUIRE(some.face_count() > all.face_count() / 4);
    REQUIRE(some.face_count() < all.face_count() * 3 / 4);
    const std::vector<double> factors = wavy_factors(whole, 0.2);
    const RadiusField of_all = radius_field(all, factors);
    const RadiusField of_some = radius_field(some, factors);
    SampleParams params = params_for(all, 3000, 11);
    params.radii = has_radii ? &of_all : nullptr;
    const LocalFaces expected = faces_of<Real>(all, params);
    params.radii = has_radii ? &of_some : nullptr;
    params.face_keys = part.keys;
    const LocalFaces found = faces_of<Real>(some, params);
    std::uint32_t wrong = 0;
    for (const std::uint32_t key : part.keys) {
        const auto a = expected.find(key);
        const auto b = found.find(key);
        wrong += (a == expected.end()) != (b == found.end()) ||
                 (a != expected.end() && a->second != b->second);
    }
    CHECK(wrong == 0);
}

/// A surface, its radii if they vary, and a job on it.
struct LocalScene {
    const TestMesh& mesh;
    PreparedMesh surface;
    RadiusField field;
    SampleParams params;

    LocalScene(const TestMesh& shape, const std::vector<double>& factors, double min_distance)
        : mesh(shape), surface(prepared(shape)) {
        if (!factors.empty()) {
            field = radius_field(surface, factors);
            params.radii = &field;
        }
        params.min_distance = min_distance;
        params.seed = 21;
    }
    LocalScene(const LocalScene&) = delete;
    LocalScene& operator=(const LocalScene&) = delete;

    std::vector<Point> samples() const {
        const ref::Surface<double> of(surface, params);
        const auto pool = ref::draw_pool(of, params);
        const ref::Tolerances tolerances = of.frame.tolerances(4 * of.frame.first_error());
        std::vector<Point> points;
        for (const std::uint32_t rank : ref::throw_darts(of, pool, tolerances).ranks) {
            points.push_back(pool.candidate(rank));
        }
        return points;
    }
};

std::tuple<std::uint32_t, double, double> place_of(const Point& p) {
    return {p.face, p.weight1, p.weight2};
}

/// Returns how far from `at`, in minimum distances, samples are that only one of both has.
double reach_of(const LocalScene& before, const LocalScene& after, Vec3 at) {
    const auto comes_before = [](const Point& p, const Point& q) {
        return place_of(p) < place_of(q);
    };
    std::vector<Point> a = before.samples();
    std::vector<Point> b = after.samples();
    std::sort(a.begin(), a.end(), comes_before);
    std::sort(b.begin(), b.end(), comes_before);
    CHECK(a.size() > 1000);
    double reach = 0;
    const auto look = [&](const TestMesh& mesh, const std::vector<Point>& mine,
                          const std::vector<Point>& others) {
        std::vector<Point> alone;
        std::set_difference(mine.begin(), mine.end(), others.begin(), others.end(),
                            std::back_inserter(alone), comes_before);
        for (const Point& p : alone) {
            reach = std::max(reach, length(mesh.position(p) - at) / before.params.min_distance);
        }
    };
    look(before.mesh, a, b);
    look(after.mesh, b, a);
    return reach;
}

/// Checks all faces but those at a vertex.
void check_other_faces(const LocalScene& before, const LocalScene& after, std::uint32_t vertex) {
    const LocalFaces a = faces_of<float>(before.surface, before.params);
    const LocalFaces b = faces_of<float>(after.surface, after.params);
    std::uint32_t wrong = 0;
    for (std::uint32_t f = 0; f < before.surface.face_count(); ++f) {
        const auto corners = before.mesh.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(f);
        if (std::find(corners, corners + 3, vertex) == corners + 3) {
            const auto x = a.find(f);
            const auto y = b.find(f);
            wrong += (x == a.end()) != (y == b.end()) || (x != a.end() && x->second != y->second);
        }
    }
    CHECK(wrong == 0);
}

} // namespace

TEST_CASE("locality: a part of a mesh with the same keys has the same candidates") {
    for (const bool has_radii : {false, true}) {
        for (const TestMesh& mesh : {builtin("torus-knot", 12), builtin("icosphere", 3)}) {
            check_part<float>(mesh, has_radii);
            check_part<double>(mesh, has_radii);
        }
    }
}

TEST_CASE("locality: keys, not their order, choose the candidates") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 2));
    SampleParams params = params_for(mesh, 500, 3);
    std::vector<std::uint32_t> keys(mesh.face_count());
    std::iota(keys.begin(), keys.end(), 0u);
    const LocalFaces plain = faces_of<float>(mesh, params);
    params.face_keys = keys;
    CHECK(faces_of<float>(mesh, params) == plain);
    for (std::uint32_t& key : keys) {
        key += 1'000'000'000;
    }
    const LocalFaces others = faces_of<float>(mesh, params);
    CHECK(others.begin()->first >= 1'000'000'000);
    CHECK(others.begin()->second != plain.begin()->second);
}

// A change decides about candidates nearer than a distance, those about others of higher rank, and
// so on: there is no end to it in theory, but each step is less likely than the one before. Of 367
// such edits the farthest change was 4.9 distances away, half of them ended within 2.7.
TEST_CASE("locality: an edit changes samples near it and no others") {
    constexpr double kReach = 6;
    const TestMesh mesh = builtin("icosphere", 4);
    const double min_distance = params_for(prepared(mesh), 2000).min_distance;
    double farthest = 0;
    for (std::uint32_t vertex = 5; vertex < mesh.vertex_count(); vertex += 67) {
        TestMesh edited = mesh;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            edited.positions[std::size_t{3} * vertex + axis] *= 1.2;
        }
        const LocalScene before(mesh, {}, min_distance);
        const LocalScene after(edited, {}, min_distance);
        check_other_faces(before, after, vertex);
        farthest = std::max(farthest, reach_of(before, after, mesh.vertex(vertex)));
    }
    CHECK(farthest > 0);
    CHECK_MESSAGE(farthest < kReach, "changes reach ", farthest, " distances");
}

TEST_CASE("locality: another radius at one vertex changes samples near it and no others") {
    constexpr double kReach = 6;
    const TestMesh mesh = builtin("icosphere", 4);
    const std::vector<double> factors = wavy_factors(mesh, 0.4);
    const double min_distance =
        distance_for_count(radius_field(prepared(mesh), factors).effective_area(), 2000);
    double farthest = 0;
    for (std::uint32_t vertex = 5; vertex < mesh.vertex_count(); vertex += 67) {
        std::vector<double> edited = factors;
        edited[vertex] *= 0.6;
        const LocalScene before(mesh, factors, min_distance);
        const LocalScene after(mesh, edited, min_distance);
        check_other_faces(before, after, vertex);
        farthest = std::max(farthest, reach_of(before, after, mesh.vertex(vertex)));
    }
    CHECK(farthest > 0);
    CHECK_MESSAGE(farthest < kReach, "changes reach ", farthest, " distances");
}
