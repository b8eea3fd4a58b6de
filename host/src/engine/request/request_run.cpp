// The runs of a request: each try for a count samples the features, then the levels or all at once.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <geodisk/request.hpp>

#include "engine/domain/classes.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/vertex_darts.hpp"
#include "engine/request/check_fields.hpp"
#include "engine/request/tries.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Factor on the distance for a count where the set is to be maximal, by packing density.
constexpr double kMaximalFactor = 0.778 / 0.721;
/// Samples on curves per minimum distance along them (measured).
constexpr double kCurveSamples = 0.75;

/// Fails for fields that exclude each other, and for a count out of range.
Result<Done> check_rules(const SampleRequest& request) {
    GEODISK_TRY(check_fields(fields_of(request)));
    const double count = request.count;
    if (count != 0 && !(count >= 1 && std::isfinite(count))) {
        return invalid("count is " + number_text(count) + ", not a number of samples");
    }
    if (count > kMaxCandidates) {
        return invalid("count is " + number_text(count) + ", more than " +
                       std::to_string(kMaxCandidates));
    }
    if (const double pool = count * request.params.pool_ratio; pool > kMaxCandidates) {
        return invalid("count is " + number_text(count) + ", which needs a pool of " +
                       number_text(pool) + " candidates, more than " +
                       std::to_string(kMaxCandidates));
    }
    if (request.is_exact && (count == 0 || count != std::floor(count))) {
        return invalid("is_exact needs a whole number of samples as count");
    }
    return Done{};
}

/// Returns about how many samples a run gives where so many fit.
double expected_of(double room, std::uint32_t stop_count) {
    const double all = std::max(1.0, room);
    return stop_count != 0 ? std::min<double>(all, stop_count) : all;
}

/// Samples of a set from one number up to another.
struct SampleRange {
    std::size_t begin, end;
};

/// Makes the steps of a request on a surface.
class SurfaceSteps {
  public:
    SurfaceSteps(const PreparedMesh& mesh, const SampleRequest& request)
        : mesh_(mesh), request_(request) {}

    /// Finds the features. Fails for fields that are out of range.
    Result<Done> prepare();

    bool has_features() const { return has_features_; }
    bool has_levels() const { return request_.order == SampleOrder::progressive; }
    const SampleRequest& request() const { return request_; }

    /// Returns the first distance to try.
    Result<double> first_distance() const;
    Levels levels_at(double distance) const;

    /// Makes the step of the features, or of a level of them, with samples that stand already.
    Result<RequestStep> on_features(double distance, const Levels& levels, std::uint32_t level,
                                    std::span<const Sample> standing) const;
    /// Makes the step of the faces, likewise.
    Result<RequestStep> on_faces(double distance, const Levels& levels, std::uint32_t level,
                                 std::span<const Sample> standing) const;

    /// Adds what is known of the features, with the samples on them.
    void describe(RequestedSet& found, std::span<const SampleRange> on_features) const;

  private:
    SampleParams params_at(double distance) const;
    /// Returns the parameters of a level, or of the whole without levels.
    Result<SampleParams> params_of(double distance, const Levels& levels, std::uint32_t level,
                                   std::span<const Sample> standing) const;
    Result<Domain> domain(const SampleParams& params) const;
    std::size_t sampled_corners() const;

    const PreparedMesh& mesh_;
    SampleRequest request_;
    std::optional<Features> features_;
    bool has_features_ = false; ///< Some are on faces that take samples.
    std::size_t corners_ = 0;
};

/// Checks that there is a number for each class, and that its existing samples are no more.
Result<Done> check_class_counts(const SampleRequest& request) {
    const auto counts = request.class_counts;
    const SampleParams& params = request.params;
    const std::size_t classes = params.class_factors.empty() ? 0 : class_count(params);
    if (counts.empty()) {
        return Done{};
    }
    if (counts.size() != classes) {
        return invalid("class_counts has " + std::to_string(counts.size()) + " numbers for " +
                       std::to_string(classes) + " classes");
    }
    std::vector<std::size_t> existing(classes);
    for (std::size_t i = 0; i < params.existing.size(); ++i) {
        const std::size_t own = params.existing_classes.empty() ? 0 : params.existing_classes[i];
        if (own < classes && ++existing[own] > counts[own]) {
            return invalid("class " + std::to_string(own) + " has more existing samples than the " +
                           std::to_string(counts[own]) + " asked for");
        }
    }
    return Done{};
}

Result<Done> SurfaceSteps::prepare() {
    const std::size_t existing = request_.params.existing.size();
    GEODISK_TRY(check_rules(request_));
    if (request_.count != 0 && static_cast<double>(existing) >= request_.count) {
        return invalid("count is " + number_text(request_.count) + ", but " +
                       std::to_string(existing) + " existing samples count too");
    }
    GEODISK_TRY(check_stop_count(request_.params));
    if (request_.keep != 0 && request_.order != SampleOrder::farthest) {
        return invalid("keep is for the farthest order");
    }
    if (request_.keep != 0 && request_.keep <= existing) {
        return invalid("keep is " + std::to_string(request_.keep) + ", but " +
                       std::to_string(existing) + " existing samples are kept too");
    }
    GEODISK_TRY(check_class_counts(request_));
    if (request_.at_vertices && request_.count != 0) {
        GEODISK_TRY(check_mask(mesh_, request_.params));
        const std::size_t most = vertex_darts(mesh_, request_.params).size() + existing;
        if (request_.count > static_cast<double>(most)) {
            return invalid("count is " + number_text(request_.count) + ", but there are only " +
                           std::to_string(most) + " vertices that take samples");
        }
    }
    const Levels& levels = request_.levels;
    if (!has_levels() && (levels.count != 0 || levels.factor != Levels{0}.factor)) {
        return invalid("levels are for the progressive order");
    }
    if ((request_.features != 0 || request_.metric) && request_.view == nullptr) {
        return invalid(std::string(request_.metric ? "metric" : "features") +
                       " needs the coordinates of the mesh, which the request does not have");
    }
    if (request_.features != 0) {
        auto found = Features::find(*request_.view, mesh_, request_.features);
        GEODISK_TRY(found);
        features_ = std::move(*found);
        has_features_ = features_->are_sampled(mesh_, request_.params);
        corners_ = sampled_corners();
    }
    return Done{};
}

std::size_t SurfaceSteps::sampled_corners() const {
    const std::span<const std::uint8_t> mask = request_.params.face_mask;
    const auto takes_samples = [&](std::uint32_t corner) {
        return mask.empty() || (corner / 3 < mask.size() && mask[corner / 3] != 0);
    };
    const auto is_sampled = [&](std::uint32_t vertex) {
        const VertexFan& fan = mesh_.fans()[vertex];
        return std::ranges::any_of(mesh_.corners().subspan(fan.first_corner, fan.corner_count),
                                   takes_samples);
    };
    return static_cast<std::size_t>(std::ranges::count_if(features_->corners(), is_sampled));
}

Result<double> SurfaceSteps::first_distance() const {
    const SampleParams& params = request_.params;
    if (request_.count == 0 || params.min_distance != 0) {
        // From far above the mesh, the first tries would all give one sample.
        return request_.count != 0 && params.min_distance > 0
                   ? std::min(params.min_distance, distance_for_count(mesh_, params, 1))
                   : params.min_distance;
    }
    SampleParams any = params;
    any.min_distance = 1; // Is not looked at, but checked.
    GEODISK_TRY(check_params(mesh_, any));
    return distance_for_count(mesh_, params, request_.count) *
           (params.maximal ? kMaximalFactor : 1);
}

Levels SurfaceSteps::levels_at(double distance) const {
    return request_.levels.count > 0
               ? request_.levels
               : levels_for(mesh_, params_at(distance), request_.levels.factor);
}

SampleParams SurfaceSteps::params_at(double distance) const {
    SampleParams params = request_.params;
    params.min_distance = distance;
    if (request_.count != 0) {
        params.stop_count = 0; // Or it would hide how many samples the distance gives.
    }
    return params;
}

Result<SampleParams> SurfaceSteps::params_of(double distance, const Levels& levels,
                                             std::uint32_t level,
                                             std::span<const Sample> standing) const {
    SampleParams params = params_at(distance);
    if (has_levels()) {
        auto own = params_of_level(params, levels, level, standing);
        GEODISK_TRY(own);
        params = *own;
    }
    params.existing = standing;
    return params;
}

Result<RequestStep> SurfaceSteps::on_features(double distance, const Levels& levels,
                                              std::uint32_t level,
                                              std::span<const Sample> standing) const {
    auto params = params_of(distance, levels, level, standing);
    GEODISK_TRY(params);
    params->darts = 0;
    params->stop_count = 0;
    auto domain = feature_domain(mesh_, *params, *features_);
    GEODISK_TRY(domain);
    RequestStep step{std::move(*domain), *params};
    step.expected = static_cast<double>(standing.size() + corners_) +
                    kCurveSamples * features_->length() / params->min_distance;
    step.level = level;
    step.is_on_features = true;
    return step;
}

Result<RequestStep> SurfaceSteps::on_faces(double distance, const Levels& levels,
                                           std::uint32_t level,
                                           std::span<const Sample> standing) const {
    const auto found = params_of(distance, levels, level, standing);
    GEODISK_TRY(found);
    const SampleParams& params = *found;
    auto made = domain(params);
    GEODISK_TRY(made);
    RequestStep step{std::move(*made), params, request_.metric ? nullptr : &mesh_};
    step.may_share = step.surface != nullptr && request_.frame == nullptr &&
                     request_.split_from == nullptr && !request_.at_vertices && params.darts == 0 &&
                     params.stop_count == 0 && params.class_factors.empty() && !params.maximal;
    step.expected = expected_of(expected_count(effective_area(mesh_, params), params.min_distance),
                                params.stop_count);
    if (request_.at_vertices) { // As a list, it has no more candidates.
        const double most =
            static_cast<double>(standing.size()) + step.domain.stages().max_expected;
        step.expected = std::min(step.expected, most);
    }
    step.level = level;
    return step;
}

Result<Domain> SurfaceSteps::domain(const SampleParams& params) const {
    if (request_.metric) {
        return Domain::surface_in_space(*request_.view, mesh_, params, *request_.metric);
    }
    if (request_.frame != nullptr) {
        return Domain::surface(mesh_, params, *request_.frame);
    }
    if (request_.at_vertices) {
        return vertex_domain(mesh_, params);
    }
    if (request_.split_from == nullptr) {
        return Domain::surface(mesh_, params);
    }
    const auto frame = frame_of(mesh_, params, *request_.split_from);
    return frame ? Domain::surface(mesh_, params, *frame) : frame.error();
}

void SurfaceSteps::describe(RequestedSet& found, std::span<const SampleRange> on_features) const {
    if (!features_) {
        return;
    }
    const std::vector<Sample>& samples = found.set.samples;
    found.features.assign(samples.size(), FeatureKind::face);
    for (const auto& [begin, end] : on_features) {
        for (std::size_t i = begin; i < std::min(end, samples.size()); ++i) {
            found.features[i] = feature_of(samples[i]);
        }
    }
    found.corners = corners_;
    found.feature_length = features_->length();
    found.lacks_features = !has_features_;
}

Result<RequestStep> box_step(const BoxParams& box) {
    auto domain = Domain::box(box);
    GEODISK_TRY(domain);
    RequestStep step{std::move(*domain)};
    step.params.min_distance = box.min_distance;
    step.expected = expected_of(expected_count(box), box.stop_count);
    return step;
}

void add_seconds(RunSeconds& sum, const RunSeconds& other) {
    sum.compile += other.compile;
    sum.upload += other.upload;
    sum.sample += other.sample;
    sum.readback += other.readback;
}

std::size_t count_of(const SampleSet& set, const Domain& domain) {
    const std::size_t dimension = domain.dimension();
    return dimension == 0 ? set.samples.size() : set.points.size() / dimension;
}

/// Leaves out all but the first samples.
void cut_to(SampleSet& set, std::size_t dimension, std::size_t count) {
    set.samples.resize(std::min(set.samples.size(), count));
    set.points.resize(std::min(set.points.size(), count * dimension));
    set.classes.resize(std::min(set.classes.size(), count));
    set.existing = std::min(set.existing, count);
}

/// Leaves out all but the first samples of each class, and existing ones.
void cut_classes(SampleSet& set, std::span<const std::uint32_t> counts, std::size_t existing) {
    std::vector<std::uint32_t> taken(counts.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        const std::uint8_t own = set.classes[i];
        if (i < existing || taken[own] < counts[own]) {
            ++taken[own];
            set.samples[kept] = set.samples[i];
            set.classes[kept++] = own;
        }
    }
    cut_to(set, 0, kept);
}

} // namespace

struct RequestRun::Impl {
    Impl(double distance, double wanted, bool exact, std::uint32_t stop = 0)
        : tries(distance, wanted, exact), count(wanted), is_exact(exact), stop_count(stop) {}

    /// Makes the first step at the distance that the tries have come to.
    Result<Done> begin_try();
    /// Makes the first step of a level, with samples that stand already.
    Result<Done> begin_level(std::uint32_t level);
    /// Makes the step of its faces.
    Result<Done> begin_faces(std::uint32_t level);
    /// Takes the samples of a step on features.
    Result<Done> take_features(SampleSet set);
    Result<Done> use(Result<RequestStep> made);
    /// Takes the samples of the last step of a try.
    Result<Done> end_try(SampleSet set);

    /// Returns how many samples of a try are kept, at most.
    std::size_t max_kept() const {
        return is_exact                        ? static_cast<std::size_t>(count)
               : count != 0 && stop_count != 0 ? stop_count
                                               : std::numeric_limits<std::size_t>::max();
    }

    Tries tries;
    double count;
    bool is_exact;
    std::uint32_t stop_count;
    std::optional<SurfaceSteps> surface;
    StepAt step_at; ///< Without a surface.
    std::optional<RequestStep> step;
    std::vector<Sample> standing;         ///< Those that the step goes on from, existing ones too.
    std::vector<SampleRange> on_features; ///< Samples of the try on features.
    Levels levels{0};                     ///< Those of the try; count 0 without any.
    std::optional<SampleSet> before;      ///< Report of the levels before.
    std::vector<std::size_t> ends;
    RunSeconds seconds;
    std::uint32_t starts = 0;
    RequestedSet best;
    std::vector<SampleRange> best_on_features; ///< Samples of `best` on features.
};

Result<Done> RequestRun::Impl::use(Result<RequestStep> made) {
    step.reset();
    GEODISK_TRY(made);
    step = std::move(*made);
    step->attempt = tries.count();
    return Done{};
}

Result<Done> RequestRun::Impl::begin_try() {
    ends.clear();
    on_features.clear();
    before.reset();
    if (!surface) {
        return use(step_at(*tries.distance()));
    }
    const std::span<const Sample> existing = surface->request().params.existing;
    standing.assign(existing.begin(), existing.end());
    if (surface->has_levels()) {
        levels = surface->levels_at(*tries.distance());
    }
    return begin_level(0);
}

Result<Done> RequestRun::Impl::begin_level(std::uint32_t level) {
    return surface->has_features()
               ? use(surface->on_features(*tries.distance(), levels, level, standing))
               : begin_faces(level);
}

Result<Done> RequestRun::Impl::begin_faces(std::uint32_t level) {
    return use(surface->on_faces(*tries.distance(), levels, level, standing));
}

Result<Done> RequestRun::Impl::take_features(SampleSet set) {
    const std::uint32_t level = step->level;
    add_seconds(seconds, set.report.seconds);
    if (count == 0 && stop_count != 0) {
        cut_to(set, 0, stop_count);
    }
    on_features.push_back({standing.size(), set.samples.size()});
    standing = std::move(set.samples);
    return begin_faces(level);
}

Result<Done> RequestRun::Impl::end_try(SampleSet set) {
    const std::size_t samples = count_of(set, step->domain);
    const double distance = *tries.distance();
    starts += set.report.starts;
    add_seconds(seconds, set.report.seconds);
    const auto is_best = tries.note(samples);
    if (!is_best) {
        step.reset();
        return is_best.error();
    }
    if (*is_best) {
        best_on_features = std::move(on_features);
        best = {};
        best.set = std::move(set);
        best.min_distance = distance;
        best.ends = std::move(ends);
        best.levels = levels;
        const std::size_t kept = std::min(samples, max_kept());
        best.cut = samples - kept;
        cut_to(best.set, step->domain.dimension(), kept);
        if (surface && !surface->request().class_counts.empty()) {
            const SampleRequest& request = surface->request();
            cut_classes(best.set, request.class_counts, request.params.existing.size());
            best.cut = samples - best.set.samples.size();
            best.ends = {best.set.samples.size()};
        }
        for (std::size_t& end : best.ends) {
            end = std::min(end, kept);
        }
    }
    if (tries.distance()) {
        return begin_try();
    }
    step.reset();
    best.tries = tries.count();
    best.set.report.seconds = seconds;
    best.set.report.starts = starts;
    if (surface) {
        surface->describe(best, best_on_features);
        best.set.existing = std::min(surface->request().params.existing.size(), best.set.existing);
    }
    return Done{};
}

RequestRun::RequestRun(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
RequestRun::RequestRun(RequestRun&&) noexcept = default;
RequestRun& RequestRun::operator=(RequestRun&&) noexcept = default;
RequestRun::~RequestRun() = default;

Result<RequestRun> RequestRun::create(const PreparedMesh& mesh,
                                      const SampleRequest& request) noexcept {
    return guarded([&]() -> Result<RequestRun> {
        SurfaceSteps steps(mesh, request);
        GEODISK_TRY(steps.prepare());
        const auto distance = steps.first_distance();
        GEODISK_TRY(distance);
        auto impl = std::make_unique<Impl>(*distance, request.count, request.is_exact,
                                           request.params.stop_count);
        impl->surface.emplace(std::move(steps));
        GEODISK_TRY(impl->begin_try());
        return RequestRun(std::move(impl));
    });
}

Result<RequestRun> RequestRun::create(const BoxRequest& request) noexcept {
    return guarded([&]() -> Result<RequestRun> {
        SampleRequest alike; // With the fields that a box has too.
        alike.count = request.count;
        alike.is_exact = request.is_exact;
        alike.params.pool_ratio = request.params.pool_ratio;
        alike.params.darts = request.params.darts;
        alike.params.stop_count = request.params.stop_count;
        GEODISK_TRY(check_rules(alike));
        double first = request.params.min_distance;
        if (request.count != 0) {
            const double most = distance_for_count(request.params, first == 0 ? request.count : 1);
            if (most == 0) { // It has no sides, or a wrong one.
                BoxParams any = request.params;
                any.min_distance = 1;
                return Domain::box(any).error();
            }
            first = first == 0 || first > most ? most : first;
        }
        auto impl = std::make_unique<Impl>(first, request.count, request.is_exact,
                                           request.params.stop_count);
        impl->step_at = [box = request.params,
                         has_count = request.count != 0](double distance) mutable {
            box.min_distance = distance;
            box.stop_count = has_count ? 0 : box.stop_count;
            return box_step(box);
        };
        GEODISK_TRY(impl->begin_try());
        return RequestRun(std::move(impl));
    });
}

Result<RequestRun> RequestRun::create(StepAt step_at, double min_distance, double count,
                                      bool is_exact) noexcept {
    return guarded([&]() -> Result<RequestRun> {
        auto impl = std::make_unique<Impl>(min_distance, count, is_exact);
        impl->step_at = std::move(step_at);
        GEODISK_TRY(impl->begin_try());
        return RequestRun(std::move(impl));
    });
}

const RequestStep* RequestRun::step() const noexcept {
    return impl_->step ? &*impl_->step : nullptr;
}

Result<Done> RequestRun::take(SampleSet set) noexcept {
    return guarded([&]() -> Result<Done> {
        Impl& run = *impl_;
        if (!run.step) {
            return invalid("the request has no step to take samples of");
        }
        if (run.step->is_on_features) {
            return run.take_features(std::move(set));
        }
        if (run.before) { // Those before are samples of this set, not existing ones.
            set.existing = run.before->existing;
            set.report.starts += run.before->report.starts;
            set.report.add(run.before->report);
        }
        run.ends.push_back(count_of(set, run.step->domain));
        const std::uint32_t next = run.step->level + 1;
        if (next < run.levels.count) {
            run.standing = std::move(set.samples);
            set.samples.clear();
            run.before = std::move(set);
            return run.begin_level(next);
        }
        return run.end_try(std::move(set));
    });
}

RequestedSet RequestRun::finish() && noexcept {
    return std::move(impl_->best);
}

} // namespace geodisk
