// Requests: their runs are those of the parts they consist of, and what contradicts is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/count_search.hpp>
#include <geodisk/request.hpp>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

Runner request_runner() {
    return expect(Runner::create(shared_context().device(), shared_context().queue()));
}

Points run_of(Runner& runner, const PreparedMesh& mesh, const SampleParams& params) {
    return points_of(expect(runner.sample_and_wait(mesh, params)));
}

/// A request with a valid value in each of two fields.
class PairRequest {
  public:
    PairRequest(RequestField a, RequestField b)
        : shape_(builtin("cube", 2)), mesh_(prepared(shape_)),
          radii_(expect(RadiusField::prepare(mesh_, std::vector<double>(mesh_.vertex_count(), 1)))),
          density_(expect(
              RadiusField::from_density(mesh_, std::vector<double>(mesh_.vertex_count(), 1)))),
          view_(shape_.view()) {
        request_.view = &view_;
        request_.params.min_distance = 0.5;
        set(a);
        set(b);
        SampleParams plain; // But for radii, a frame knows no more.
        plain.min_distance = 0.5;
        plain.radii = request_.params.radii;
        frame_ = expect(frame_of(mesh_, plain));
    }

    const SampleRequest& request() const { return request_; }
    const PreparedMesh& mesh() const { return mesh_; }

  private:
    void set(RequestField field) {
        SampleParams& params = request_.params;
        switch (field) {
        case RequestField::min_distance:
            break;
        case RequestField::count:
            request_.count = 20;
            break;
        case RequestField::is_exact:
            request_.count = 20;
            request_.is_exact = true;
            break;
        case RequestField::darts:
            params.darts = 100;
            break;
        case RequestField::stop_count:
            params.stop_count = 10;
            break;
        case RequestField::maximal:
            params.maximal = true;
            break;
        case RequestField::radii:
            params.radii = &radii_;
            break;
        case RequestField::density:
            params.radii = &density_;
            break;
        case RequestField::class_factors:
            params.class_factors = factors_;
            break;
        case RequestField::class_counts:
            params.class_factors = factors_;
            request_.class_counts = counts_;
            break;
        case RequestField::face_keys:
            keys_.resize(mesh_.face_count());
            std::iota(keys_.begin(), keys_.end(), 5);
            params.face_keys = keys_;
            break;
        case RequestField::existing:
            params.existing = given_;
            break;
        case RequestField::avoid:
            params.avoid = avoided_;
            break;
        case RequestField::features:
            request_.features = 30;
            break;
        case RequestField::progressive:
            request_.order = SampleOrder::progressive;
            break;
        case RequestField::farthest:
            request_.order = SampleOrder::farthest;
            break;
        case RequestField::keep:
            if (request_.order == SampleOrder::dart) {
                request_.order = SampleOrder::farthest;
            }
            request_.keep = 3;
            break;
        case RequestField::metric:
            request_.metric = Metric::euclidean;
            break;
        case RequestField::frame:
            request_.frame = &frame_;
            break;
        case RequestField::split_from:
            request_.split_from = &mesh_;
            break;
        case RequestField::at_vertices:
            request_.at_vertices = true;
            break;
        case RequestField::update:
        case RequestField::processes:
        case RequestField::frames:
            break; // Of no request for Runner.
        }
    }

    TestMesh shape_;
    PreparedMesh mesh_;
    RadiusField radii_, density_;
    MeshView view_;
    JobFrame frame_;
    std::array<float, 4> factors_{1, 0.5F, 0.5F, 1};
    std::array<std::uint32_t, 2> counts_{9, 9};
    std::vector<std::uint32_t> keys_;
    std::array<Sample, 1> given_{{{0, {1, 0, 0}}}};
    std::array<KeepOut, 1> avoided_{{{{0, {1, 0, 0}}, 0.1}}};
    SampleRequest request_;
};

constexpr auto kLastField = RequestField::at_vertices;

} // namespace

TEST_SUITE("request") {
    TEST_CASE("more existing samples than the stop count are refused, with features too") {
        const TestMesh shape = builtin("cube", 3);
        const PreparedMesh mesh = prepared(shape);
        const MeshView view = shape.view();
        const std::vector<Sample> existing{{0, {1, 0, 0}}, {9, {1, 0, 0}}, {20, {0, 1, 0}}};
        Runner runner = request_runner();
        SampleRequest request;
        request.params.min_distance = 0.2;
        request.params.existing = existing;
        request.params.stop_count = 2;
        request.view = &view;
        for (const double features : {0.0, 30.0}) {
            request.features = features;
            const auto refused = sample(runner, mesh, request);
            REQUIRE_FALSE(refused);
            CHECK(refused.error().message ==
                  "there are 3 existing samples, more than the stop count of 2");
        }
        request.params.stop_count = 3;
        CHECK(expect(sample(runner, mesh, request)).set.samples.size() == 3);
    }

    TEST_CASE("features come first, at each distance that a count tries") {
        const TestMesh shape = builtin("cube", 3);
        const PreparedMesh mesh = prepared(shape);
        const MeshView view = shape.view();
        Runner runner = request_runner();
        SampleRequest request;
        request.params.seed = 4;
        request.count = 300;
        request.is_exact = true;
        request.features = 30;
        request.view = &view;
        const RequestedSet found = expect(sample(runner, mesh, request));

        const Features features = expect(Features::find(view, mesh, 30));
        CountSearch search = CountSearch::exact(300);
        SampleParams params = request.params;
        params.min_distance = distance_for_count(mesh, params, 300);
        Points best;
        double distance = 0;
        std::size_t on_features = 0;
        for (;;) {
            params.existing = {};
            const SampleSet first =
                expect(runner.sample_and_wait(expect(feature_domain(mesh, params, features))));
            params.existing = first.samples;
            const Points points = run_of(runner, mesh, params);
            const auto next = search.note(params.min_distance, points.size());
            if (search.is_nearest()) {
                best = points;
                distance = params.min_distance;
                on_features = first.samples.size();
            }
            if (!next) {
                break;
            }
            params.min_distance = *next;
        }
        CHECK(found.tries == search.tries());
        CHECK(found.tries > 1);
        CHECK(found.min_distance == distance);
        CHECK(found.cut == best.size() - 300);
        best.resize(300);
        CHECK(points_of(found.set) == best);
        CHECK(found.set.existing == 0);
        CHECK(found.corners == 8);
        REQUIRE(found.features.size() == 300);
        const auto faces = std::ranges::count(found.features, FeatureKind::face);
        CHECK(static_cast<std::size_t>(faces) == 300 - on_features);
        CHECK(std::ranges::count(found.features, FeatureKind::corner) == 8);
    }

    TEST_CASE("levels go on from one another, also when a count chooses the distance") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 16));
        Runner runner = request_runner();
        SampleRequest request;
        request.count = 400;
        request.order = SampleOrder::progressive;
        const RequestedSet found = expect(sample(runner, mesh, request));

        SampleParams last = request.params;
        last.min_distance = found.min_distance;
        const Levels levels = levels_for(mesh, last);
        CHECK(found.levels.count == levels.count);
        REQUIRE(found.ends.size() == levels.count);
        std::vector<Sample> before;
        for (std::uint32_t level = 0; level < levels.count; ++level) {
            const SampleParams params = expect(params_of_level(last, levels, level, before));
            before = expect(runner.sample_and_wait(mesh, params)).samples;
            CHECK(found.ends[level] == before.size());
        }
        SampleSet by_hand;
        by_hand.samples = before;
        CHECK(points_of(found.set) == points_of(by_hand));
        CHECK(found.set.existing == 0);
    }

    TEST_CASE("each level has features first, then faces") {
        const TestMesh shape = builtin("cube", 4);
        const PreparedMesh mesh = prepared(shape);
        const MeshView view = shape.view();
        const std::array<Sample, 2> existing{
            {{3, {0.25f, 0.25f, 0.5f}}, {9, {0.5f, 0.25f, 0.25f}}}};
        Runner runner = request_runner();
        SampleRequest request;
        request.count = 400;
        request.is_exact = true;
        request.features = 30;
        request.order = SampleOrder::progressive;
        request.params.existing = existing;
        request.view = &view;
        const RequestedSet found = expect(sample(runner, mesh, request));
        REQUIRE(found.set.samples.size() == 400);
        CHECK(found.set.existing == 2);

        const Features features = expect(Features::find(view, mesh, 30));
        SampleParams last = request.params;
        last.min_distance = found.min_distance;
        const Levels levels = levels_for(mesh, last);
        REQUIRE(levels.count > 2);
        REQUIRE(found.ends.size() == levels.count);
        std::vector<Sample> before(existing.begin(), existing.end());
        std::vector<FeatureKind> kinds(2, FeatureKind::face);
        for (std::uint32_t level = 0; level < levels.count; ++level) {
            SampleParams params = expect(params_of_level(last, levels, level, before));
            const SampleSet first =
                expect(runner.sample_and_wait(expect(feature_domain(mesh, params, features))));
            for (std::size_t i = kinds.size(); i < first.samples.size(); ++i) {
                kinds.push_back(feature_of(first.samples[i]));
                CHECK(kinds.back() != FeatureKind::face);
            }
            params.existing = first.samples;
            before = expect(runner.sample_and_wait(mesh, params)).samples;
            kinds.resize(before.size(), FeatureKind::face);
            CHECK(found.ends[level] == std::min<std::size_t>(before.size(), 400));
        }
        SampleSet by_hand;
        by_hand.samples = before;
        by_hand.samples.resize(400);
        kinds.resize(400);
        CHECK(points_of(found.set) == points_of(by_hand));
        CHECK(found.features == kinds);
        CHECK(std::ranges::count(kinds, FeatureKind::corner) == 8);

        request.count = 0;
        request.is_exact = false;
        request.params.min_distance = found.min_distance;
        for (const std::size_t stop : {found.ends[0] + 3, found.ends[1] + 1, std::size_t{380}}) {
            request.params.stop_count = static_cast<std::uint32_t>(stop);
            const RequestedSet stopped = expect(sample(runner, mesh, request));
            by_hand.samples.assign(before.begin(),
                                   before.begin() + static_cast<std::ptrdiff_t>(stop));
            CHECK(points_of(stopped.set) == points_of(by_hand));
        }
    }

    TEST_CASE("the farthest order takes along what belongs to the samples") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        Runner runner = request_runner();
        SampleRequest request;
        request.params.min_distance = 0.4;
        const RequestedSet all = expect(sample(runner, mesh, request));
        request.order = SampleOrder::farthest;
        request.keep = 12;
        const RequestedSet found = expect(sample(runner, mesh, request));
        REQUIRE(found.farthest);
        const FarthestOrder order = expect(farthest_order(runner, mesh, all.set.samples, {12}));
        CHECK(found.farthest->indices == order.indices);
        const Points of_all = points_of(all.set), points = points_of(found.set);
        REQUIRE(points.size() == 12);
        for (std::size_t i = 0; i < 12; ++i) {
            CHECK(points[i] == of_all[order.indices[i]]);
        }
    }

    TEST_CASE("a box takes the distance that gives a count, exactly or about") {
        Runner runner = request_runner();
        BoxRequest request;
        request.params.extents = {1, 2, 0.5};
        request.params.seed = 3;
        request.count = 90;
        request.is_exact = true;
        const RequestedSet found = expect(sample(runner, request));
        CHECK(found.set.points.size() == 3 * 90);
        CountSearch search = CountSearch::exact(90);
        BoxParams box = request.params;
        box.min_distance = distance_for_count(box, 90);
        std::vector<double> best;
        double distance = 0;
        for (std::optional<double> next = box.min_distance; next;) {
            box.min_distance = *next;
            const auto set = expect(runner.sample_and_wait(expect(Domain::box(box))));
            next = search.note(box.min_distance, set.points.size() / 3);
            if (search.is_nearest()) {
                best = set.points;
                distance = box.min_distance;
            }
        }
        CHECK(found.tries == search.tries());
        CHECK(found.min_distance == distance);
        CHECK(found.cut == best.size() / 3 - 90);
        best.resize(3 * 90);
        CHECK(found.set.points == best);

        request.is_exact = false;
        request.params.stop_count = 20; // After the search, which it must not mislead.
        CHECK(expect(sample(runner, request)).set.points.size() == 3 * 20);
        request.is_exact = true;
        CHECK(sample(runner, request).error().message.starts_with("is_exact and stop_count"));
        request.params.stop_count = 0;
        request.params.darts = 100;
        CHECK(sample(runner, request).error().message.starts_with("is_exact and darts"));
        request = {};
        CHECK_FALSE(sample(runner, request)); // No distance.
        request.count = 5;
        request.params.extents = {1, -1};
        CHECK(sample(runner, request).error().message.starts_with("side 2 of the box must be"));
        request.count = 0.5;
        CHECK(sample(runner, request).error().message.starts_with("count is 0.5"));
    }

    TEST_CASE("a first distance far above the mesh is no lack of room") {
        const PreparedMesh mesh = prepared(builtin("cube", 3));
        Runner runner = request_runner();
        SampleRequest request;
        request.count = 100;
        request.params.min_distance = 1e6;
        const std::size_t found = expect(sample(runner, mesh, request)).set.samples.size();
        CHECK(found >= 95);
        CHECK(found <= 105);
        BoxRequest box;
        box.count = 100;
        box.params.min_distance = 1e6;
        const std::size_t points = expect(sample(runner, box)).set.points.size() / 2;
        CHECK(points >= 95);
        CHECK(points <= 105);
    }

    TEST_CASE("a count with no room for it is refused") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 2));
        Runner runner = request_runner();
        const std::array<KeepOut, 1> everywhere{{{{0, {1, 0, 0}}, 10}}};
        SampleRequest request;
        request.count = 20;
        request.params.avoid = everywhere;
        const auto none = sample(runner, mesh, request);
        REQUIRE_FALSE(none);
        CHECK(none.error().status == Status::invalid_argument);
        CHECK(none.error().message.starts_with("count: found no room for a sample"));
    }

    TEST_CASE("fields that exclude each other are refused by name, and no others") {
        const int last = static_cast<int>(kLastField);
        for (int i = 0; i <= last; ++i) {
            for (int k = 0; k <= last; ++k) {
                const auto a = static_cast<RequestField>(i), b = static_cast<RequestField>(k);
                const PairRequest pair(a, b);
                const RequestRule* const rule = broken_rule(fields_of(pair.request()));
                const auto is_rule = [&](RequestField x, RequestField y) {
                    return std::ranges::any_of(request_rules(), [&](const RequestRule& one) {
                        return one.field == x && one.other == y;
                    });
                };
                CAPTURE(to_string(a));
                CAPTURE(to_string(b));
                const auto run = RequestRun::create(pair.mesh(), pair.request());
                if (is_rule(a, b) || is_rule(b, a)) {
                    REQUIRE(rule != nullptr);
                }
                if (rule != nullptr) {
                    REQUIRE_FALSE(run);
                    const std::string text = run.error().message;
                    CHECK(run.error().status == Status::invalid_argument);
                    CHECK(text.find(to_string(rule->field)) != std::string::npos);
                    CHECK(text.find(to_string(rule->other)) != std::string::npos);
                } else {
                    INFO((run ? "" : run.error().message));
                    CHECK(run);
                }
            }
        }
    }

    TEST_CASE("fields out of range are refused") {
        const PreparedMesh mesh = prepared(builtin("cube", 1));
        const auto refusal = [&](const SampleRequest& request) {
            const auto run = RequestRun::create(mesh, request);
            return run ? std::string() : run.error().message;
        };
        SampleRequest request;
        CHECK_FALSE(refusal(request).empty()); // No distance.
        request.count = 0.5;
        CHECK(refusal(request).starts_with("count is 0.5"));
        const std::vector<Sample> given(5, Sample{0, {1, 0, 0}});
        request.count = 5;
        request.params.existing = given;
        CHECK(refusal(request) == "count is 5, but 5 existing samples count too");
        request.params.existing = {};
        request.count = 10.5;
        request.is_exact = true;
        CHECK(refusal(request).starts_with("is_exact needs a whole number"));
        request = {};
        request.params.min_distance = 0.3;
        request.keep = 5;
        CHECK(refusal(request) == "keep is for the farthest order");
        request.keep = 0;
        request.levels.count = 3;
        CHECK(refusal(request) == "levels are for the progressive order");
        request.levels = Levels{0, 3.0};
        CHECK(refusal(request) == "levels are for the progressive order");
        request.levels = Levels{0};
        request.count = 1e12;
        CHECK(refusal(request).starts_with("count is 1e+12, more than 4294967295"));
        request.count = 1e9;
        CHECK(refusal(request).starts_with("count is 1e+09, which needs a pool of 2e+10 cand"));
        request.count = 0;
        request.keep = 0;
        request.features = 30;
        CHECK(refusal(request).starts_with("features needs the coordinates"));
        TestMesh line;
        line.positions = {0, 0, 0, 1, 0, 0, 0.5, 1e-10, 0};
        line.triangles = {0, 1, 2};
        request.features = 0;
        request.params.min_distance = 100;
        const auto run = RequestRun::create(prepared(line), request);
        REQUIRE_FALSE(run);
        CHECK(run.error().message.ends_with("it has hardly any area"));
    }
}

} // namespace geodisk::test
