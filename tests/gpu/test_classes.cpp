// Classes of samples: sets against those of the twins.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
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

/// Shares that are the same everywhere, of each class.
std::vector<float> shares_of(const PreparedMesh& mesh, const std::vector<float>& of_class) {
    std::vector<float> shares;
    for (const float share : of_class) {
        shares.insert(shares.end(), std::size_t{3} * mesh.face_count(), share);
    }
    return shares;
}

/// Number of samples of the first and of other classes within a distance from a point.
std::array<std::size_t, 2> classes_within(const PreparedMesh& mesh, const SampleSet& set,
                                          const Sample& center, double distance) {
    std::vector<Point> points;
    for (const Sample& s : set.samples) {
        points.push_back({s.face, s.weights[1], s.weights[2]});
    }
    GeodesicQuery<double> query(mesh, 1.1 * distance, points, tight_tolerances());
    const std::vector<double> distances =
        query.from({center.face, center.weights[1], center.weights[2]});
    std::array<std::size_t, 2> counts{};
    for (std::size_t i = 0; i < distances.size(); ++i) {
        counts[set.classes[i] == 0 ? 0 : 1] += std::size_t{distances[i] < distance};
    }
    return counts;
}

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

    TEST_CASE("shares of classes: none, some and all of the samples that fit") {
        for (const auto& [name, resolution, count] :
             {std::tuple{"torus-knot", 8, 100.0}, {"cube", 1, 400.0}}) {
            const char* const shown = name;
            CAPTURE(shown);
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            SampleParams params = params_for(mesh, count, 3);
            params.class_factors = kThree;
            const std::vector<float> whole(shares_of(mesh, {1, 1, 1}));
            const SampleSet all = check_classed(mesh, params);
            params.class_shares = whole;
            CHECK(points_of(check_classed(mesh, params)) == points_of(all));

            // The first class on odd faces alone, the second with less towards corner 2, the third
            // nowhere.
            std::vector<float> shares = shares_of(mesh, {1, 0.6f, 0});
            for (std::size_t f = 0; f < mesh.face_count(); ++f) {
                std::fill_n(&shares[3 * f], 3, static_cast<float>(f % 2));
                shares[3 * (mesh.face_count() + f) + 2] = 0.1f;
            }
            params.class_shares = shares;
            const SampleSet set = check_classed(mesh, params);
            const auto counts = counts_of(set.classes, 3);
            CHECK(counts[0] > 0);
            CHECK(counts[1] > 0);
            CHECK(counts[2] == 0);
            for (std::size_t i = 0; i < set.samples.size(); ++i) {
                CHECK((set.classes[i] != 0 || set.samples[i].face % 2 == 1));
            }
            RunnerOptions narrow, groups;
            narrow.plan.slots = 16;
            narrow.plan.stages = 1;
            groups.plan.disks_by = DisksBy::groups;
            CHECK(points_of(check_classed(mesh, params, narrow)) == points_of(set));
            CHECK(points_of(check_classed(mesh, params, groups)) == points_of(set));
            params.stop_count = static_cast<std::uint32_t>(set.samples.size() / 2);
            check_classed(mesh, params);
            params.stop_count = 0;
            params.darts = 1000;
            check_classed(mesh, params);
        }
    }

    TEST_CASE("points to avoid that keep out one class") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 100, 3);
        const Factors many = max_factors();
        for (const Factors* factors : {&kThree, &many}) {
            params.class_factors = *factors;
            params.avoid = {};
            params.avoid_classes = {};
            const SampleSet free = sample(mesh, params);
            const auto last = static_cast<std::uint8_t>(factors == &kThree ? 2 : 7);
            const std::vector<KeepOut> avoid{{free.samples[30], 4 * params.min_distance},
                                             {free.samples[5], 0.7 * params.min_distance},
                                             {free.samples[9], 2 * params.min_distance}};
            const Classes classes{0, last, kAllClasses};
            params.avoid = avoid;
            params.avoid_classes = classes;
            const SampleSet set = check_classed(mesh, params);
            RunnerOptions groups;
            groups.plan.disks_by = DisksBy::groups;
            CHECK(points_of(check_classed(mesh, params, groups)) == points_of(set));
            const Sample& center = free.samples[30];
            const auto inside = classes_within(mesh, set, center, avoid[0].radius);
            CHECK(inside[0] == 0);
            CHECK(inside[1] > 0);
        }
        const Classes two{0, 1}, high{0, 8, 0};
        params.avoid_classes = two;
        CHECK(refusal(mesh, params) == "there are 2 classes for 3 disks to avoid");
        params.avoid_classes = high;
        CHECK(refusal(mesh, params) ==
              "point to avoid 1 keeps out class 8, but there are 8, numbered from 0");
    }

    TEST_CASE("what no shares are") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        SampleParams params = params_for(mesh, 100);
        std::vector<float> shares = shares_of(mesh, {1, 1, 1});
        params.class_shares = shares;
        CHECK(refusal(mesh, params) == "classes have shares, but there is no table of classes");
        params.class_factors = kUneven;
        CHECK(refusal(mesh, params) ==
              "there are 108 shares of classes; 2 classes take 3 for each of 12 faces");
        params.class_factors = kThree;
        for (const float wrong : {1.5f, -0.5f, std::numeric_limits<float>::quiet_NaN()}) {
            shares[41] = wrong;
            CHECK(refusal(mesh, params).starts_with("the share of class 1 in face 1 is "));
        }
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
