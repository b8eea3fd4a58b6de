// Masks of faces without a device: areas, distances for counts, candidates and errors.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <geodisk/domain.hpp>

#include "kernels/pool.hpp"
#include "ref/dart_check.hpp"
#include "support/radius_fields.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

using Mask = std::vector<std::uint8_t>;

std::string refusal(const PreparedMesh& mesh, const SampleParams& params) {
    const auto size = pool_size(mesh, params);
    REQUIRE_FALSE(size);
    CHECK(size.error().status == Status::invalid_argument);
    CHECK(Domain::surface(mesh, params).error().message == size.error().message);
    return size.error().message;
}

/// Candidates on the faces of the mask, in dart order.
std::vector<Point> candidates_on(const PreparedMesh& mesh, const SampleParams& params,
                                 const Mask& mask) {
    std::vector<Point> points =
        ref::draw_pool(ref::Surface<double>(mesh, params), params).by_rank();
    std::erase_if(points, [&](const Point& p) { return mask[p.face] == 0; });
    return points;
}

bool are_equal(const std::vector<Point>& a, const std::vector<Point>& b) {
    return std::ranges::equal(a, b, [](const Point& p, const Point& q) {
        return p.face == q.face && p.weight1 == q.weight1 && p.weight2 == q.weight2;
    });
}

} // namespace

TEST_CASE("face mask: the area is that of the faces left") {
    const TestMesh square = flat_grid(10, 10, 1, 1);
    const PreparedMesh mesh = prepared(square);
    Mask mask = mask_above(square, 0);
    SampleParams params;
    params.face_mask = mask;
    CHECK(effective_area(mesh, params) == doctest::Approx(0.5).epsilon(1e-12));
    const RadiusField field = radius_field(mesh, std::vector<double>(square.vertex_count(), 0.5));
    params.radii = &field;
    CHECK(effective_area(mesh, params) == doctest::Approx(2).epsilon(1e-4));
    const RadiusField density =
        density_field(mesh, density_along(square, [](double x) { return x; }));
    params.radii = &density;
    CHECK(effective_area(mesh, params) ==
          doctest::Approx(0.75 * density.effective_area()).epsilon(1e-5));
    std::ranges::fill(mask, std::uint8_t{1});
    CHECK(effective_area(mesh, params) == density.effective_area());
}

TEST_CASE("face mask: a count leads to the distance of the part by itself") {
    const TestMesh wide = flat_grid(10, 10, 1, 1);
    const PreparedMesh mesh = prepared(wide);
    const Mask mask = mask_above(wide, 0);
    SampleParams params;
    params.face_mask = mask;
    const double part = distance_for_count(prepared(flat_grid(5, 10, 0.5, 1)), {}, 100);
    CHECK(distance_for_count(mesh, params, 100) == doctest::Approx(part).epsilon(1e-9));
    CHECK(part < distance_for_count(mesh, {}, 100));
}

TEST_CASE("face mask: removes candidates and changes no other") {
    const TestMesh shape = builtin("torus-knot", 8);
    const PreparedMesh mesh = prepared(shape);
    const Mask mask = mask_above(shape, 1);
    const RadiusField waves = radius_field(mesh, wavy_factors(shape, 0.2));
    const RadiusField density = density_field(mesh, rough_density(shape));
    for (const RadiusField* field : {static_cast<const RadiusField*>(nullptr), &waves, &density}) {
        SampleParams params = params_for(mesh, 300, 11);
        params.radii = field;
        const std::vector<Point> all = candidates_on(mesh, params, mask);
        params.face_mask = mask;
        const Mask any(mesh.face_count(), 1);
        CHECK(are_equal(candidates_on(mesh, params, any), all));
        CHECK(all.size() > 1000);
    }
}

TEST_CASE("face mask: the pool is that of the faces left, at least 64 candidates") {
    const PreparedMesh mesh = prepared(builtin("cube", 4));
    Mask mask(mesh.face_count(), 0);
    mask[5] = 1;
    SampleParams params = params_for(mesh, 20, 1);
    params.face_mask = mask;
    const auto size = pool_size(mesh, params);
    REQUIRE(size);
    CHECK(*size == 64);
    const auto candidates = ref::draw_pool(ref::Surface<double>(mesh, params), params).by_rank();
    CHECK(candidates.size() > 30);
    CHECK(std::ranges::all_of(candidates, [](const Point& p) { return p.face == 5; }));
}

TEST_CASE("face mask: errors") {
    TestMesh square = flat_grid(4, 4, 1, 1);
    square.add_triangle(0, 1, 2); // Without area.
    const PreparedMesh mesh = prepared(square);
    SampleParams params = params_for(mesh, 20);
    Mask mask(mesh.face_count() - 1, 1);
    params.face_mask = mask;
    CHECK(refusal(mesh, params) == "the face mask is for 32 faces, the mesh has 33");
    mask.assign(mesh.face_count(), 0);
    params.face_mask = mask;
    CHECK(refusal(mesh, params) == "the face mask leaves out all faces, so no samples fit");
    mask.back() = 1;
    CHECK(refusal(mesh, params) ==
          "no face that the face mask leaves has an area, so no samples fit");
    mask[0] = 1;
    const RadiusField density =
        density_field(mesh, density_along(square, [](double x) { return x < 0.5 ? 0.0 : 1.0; }));
    params.radii = &density;
    CHECK(refusal(mesh, params) == "the density is 0 or there is no area on all faces that the "
                                   "face mask leaves, so no samples fit");
}
