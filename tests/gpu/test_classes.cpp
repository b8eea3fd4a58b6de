// Classes of samples: sets against those of the twins.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <geodisk/domain.hpp>

#include "constants.h"
#include "device_run.hpp"
#include "sets.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

using Classes = std::vector<std::uint8_t>;
using Factors = std::vector<float>;

const Factors kThree{1, 0.577f, 0.577f, 0.577f, 1, 0.577f, 0.577f, 0.577f, 1};
const Factors kUneven{1, 0.3f, 0.3f, 0.2f};
const Factors kRepelling{0.2f, 1, 1, 0.1f};

/// As many classes as there may be.
Factors max_factors() {
    Factors factors(std::size_t{gpu::kMaxClasses} * gpu::kMaxClasses, 0.4f);
    for (std::size_t i = 0; i < gpu::kMaxClasses; ++i) {
        factors[i * (gpu::kMaxClasses + 1)] = 1;
    }
    return factors;
}

/// Checks that the set is that of both twins, with its classes.
SampleSet check_classed(const PreparedMesh& mesh, const SampleParams& params,
                        const RunnerOptions& options = {}) {
    const SampleSet set = sample(mesh, params, options);
    const double bound = set.report.plan.error_bound;
    Classes classes;
    CHECK(points_of(set) == float_set(mesh, params, bound, classes));
    CHECK(set.classes == classes);
    CHECK(points_of(set) == double_set(mesh, params, bound));
    return set;
}

std::vector<std::size_t> counts_of(const Classes& classes, std::size_t count) {
    std::vector<std::size_t> counts(count);
    for (const std::uint8_t number : classes) {
        ++counts[number];
    }
    return counts;
}

std::string refusal(const PreparedMesh& mesh, const SampleParams& params) {
    const auto domain = Domain::surface(mesh, params);
    REQUIRE_FALSE(domain);
    CHECK(domain.error().status == Status::invalid_argument);
    return domain.error().message;
}

/// Distances between samples of a set with classes, by the twin in double precision.
struct ClassPairs {
    std::size_t violations = 0;
    double closest_free =
        std::numeric_limits<double>::infinity(); ///< Of classes without a distance.

    ClassPairs(const PreparedMesh& mesh, const SampleParams& params, const SampleSet& set) {
        std::vector<Point> points;
        for (const Sample& s : set.samples) {
            points.push_back({s.face, s.weights[1], s.weights[2]});
        }
        const auto count = static_cast<std::size_t>(std::sqrt(params.class_factors.size()));
        GeodesicQuery<double> query(mesh, 1.1 * params.min_distance, points, tight_tolerances());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::vector<double> distances = query.from(points[i]);
            for (std::size_t k = 0; k < i; ++k) {
                const double factor = params.class_factors[count * set.classes[i] + set.classes[k]];
                violations += distances[k] < factor * params.min_distance;
                closest_free = factor == 0 ? std::min(closest_free, distances[k]) : closest_free;
            }
        }
    }
};

} // namespace

TEST_SUITE("classes") {
    TEST_CASE("sets with classes, on small faces and large ones") {
        for (const auto& [name, resolution, count] :
             {std::tuple{"torus-knot", 8, 60.0}, {"icosphere", 3, 20.0}, {"cube", 1, 60.0}}) {
            const char* const shown = name;
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            for (const Factors* factors : {&kThree, &kUneven, &kRepelling}) {
                SampleParams params = params_for(mesh, count, 3);
                params.class_factors = *factors;
                const SampleSet set = check_classed(mesh, params);
                const auto counts = counts_of(set.classes, factors == &kThree ? 3 : 2);
                CHECK(std::ranges::all_of(counts, [](std::size_t n) { return n > 0; }));
            }
        }
    }

    TEST_CASE("as many classes as there may be") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 60, 3);
        const Factors factors = max_factors();
        params.class_factors = factors;
        const SampleSet set = check_classed(mesh, params);
        const auto counts = counts_of(set.classes, gpu::kMaxClasses);
        CHECK(std::ranges::all_of(counts, [](std::size_t n) { return n > 0; }));
    }

    TEST_CASE("in pieces of the pool, with few slots, and by work groups") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 40, 3);
        params.class_factors = kThree;
        RunnerOptions narrow;
        narrow.plan.slots = 16;
        narrow.plan.stages = 1;
        RunnerOptions groups;
        groups.plan.disks_by = DisksBy::groups;
        const SampleSet set = check_classed(mesh, params);
        CHECK(points_of(check_classed(mesh, params, narrow)) == points_of(set));
        CHECK(points_of(check_classed(mesh, params, groups)) == points_of(set));
    }

    TEST_CASE("every pair keeps its distance") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params = params_for(mesh, 150, 5);
        params.class_factors = kUneven;
        const SampleSet set = sample(mesh, params);
        CHECK(ClassPairs(mesh, params, set).violations == 0);
    }

    TEST_CASE("two classes that keep no distance know nothing of each other") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 150, 5);
        const Factors free{1, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 0.5f, 1};
        params.class_factors = free;
        RunnerOptions groups;
        groups.plan.disks_by = DisksBy::groups;
        const SampleSet set = check_classed(mesh, params);
        CHECK(points_of(check_classed(mesh, params, groups)) == points_of(set));
        const ClassPairs pairs(mesh, params, set);
        CHECK(pairs.violations == 0);
        CHECK(pairs.closest_free < 0.1 * params.min_distance);
        const Factors bare{0, 1, 1, 1};
        params.class_factors = bare;
        CHECK(refusal(mesh, params) == "the factor of classes 0 and 0 is 0, not from 0.01 to 1");
    }

    TEST_CASE("with existing samples, points to avoid, masks, darts, keys and a stop count") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params = params_for(mesh, 100, 3);
        params.class_factors = kThree;
        const SampleSet whole = check_classed(mesh, params);
        const std::vector<Sample> given(whole.samples.begin(), whole.samples.begin() + 20);
        const Classes classes(whole.classes.begin(), whole.classes.begin() + 20);
        params.existing = given;
        params.existing_classes = classes;
        CHECK(points_of(sample(mesh, params)) == points_of(whole));
        CHECK(sample(mesh, params).classes == whole.classes);
        params.existing_classes = {};
        params.seed = 4;
        check_classed(mesh, params);
        const std::vector<KeepOut> avoid{{whole.samples[30], 3 * params.min_distance}};
        params.avoid = avoid;
        check_classed(mesh, params);
        const std::vector<std::uint8_t> mask = mask_above(shape, 0);
        params.face_mask = mask;
        params.stop_count = 60;
        check_classed(mesh, params);
        params.stop_count = 0;
        params.darts = 3000;
        check_classed(mesh, params);
    }

    TEST_CASE("what no classes are") {
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        SampleParams params = params_for(mesh, 100);
        const Factors five(5, 1), one(1, 1), eighty_one(81, 1), odd{1, 0.5f, 0.6f, 1},
            small{1, 0.001f, 0.001f, 1}, large{1, 2, 2, 1}, nan{1, NAN, NAN, 1};
        for (const auto& [factors, part] : {std::pair{&five, "has 5 factors"},
                                            {&one, "2 to 8 classes"},
                                            {&eighty_one, "2 to 8 classes"},
                                            {&odd, "not symmetric"},
                                            {&small, "not 0 or from 0.01 to 1"},
                                            {&large, "not 0 or from 0.01 to 1"},
                                            {&nan, "not 0 or from 0.01 to 1"}}) {
            params.class_factors = *factors;
            CHECK(refusal(mesh, params).find(part) != std::string::npos);
        }
        params.class_factors = kThree;
        const Classes wrong{0, 3};
        const std::vector<Sample> given(2, Sample{1, {0.5f, 0.25f, 0.25f}});
        params.existing_classes = wrong;
        CHECK(refusal(mesh, params).find("2 classes for 0 existing") != std::string::npos);
        params.existing = given;
        CHECK(refusal(mesh, params).find("has class 3") != std::string::npos);
        params.existing_classes = {};
        const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.3));
        params.radii = &radii;
        CHECK(refusal(mesh, params).starts_with("class_factors and radii exclude each other"));
    }
}

} // namespace geodisk::test
