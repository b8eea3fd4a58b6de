#include "sets.hpp"

#include "device_run.hpp"
#include "kernels/detect.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "throw_darts.hpp"

namespace geodisk::test {
namespace {

/// Returns the pool of these candidates, in this order.
template <class Real>
ref::Pool<Real> pool_of(const ref::Surface<Real>& surface, const Points& candidates) {
    std::vector<ref::FacePoint<Real>> points;
    for (const auto& [face, second, third] : candidates) {
        points.push_back({face, second, third});
    }
    ref::Pool<Real> pool;
    pool.bins = ref::Bins<Real>(surface, points);
    pool.places.resize(points.size());
    for (std::uint32_t place = 0; place < points.size(); ++place) {
        pool.places[pool.bins.order[place]] = place;
    }
    return pool;
}

template <class Real>
Points sequential_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                      const Points* candidates = nullptr,
                      std::vector<std::uint8_t>* classes = nullptr) {
    expect(pool_size(mesh, params));
    const ref::Surface<Real> surface(mesh, params);
    const ref::Pool<Real> pool =
        candidates != nullptr ? pool_of(surface, *candidates) : ref::draw_pool(surface, params);
    Points points;
    std::vector<ref::FacePoint<Real>> given;
    for (const Sample& sample : params.existing) {
        points.push_back({sample.face, sample.weights[1], sample.weights[2]});
        given.push_back({sample.face, sample.weights[1], sample.weights[2]});
    }
    std::vector<ref::AvoidedPoint<Real>> avoided;
    for (std::size_t i = 0; i < params.avoid.size(); ++i) {
        const auto& [center, radius] = params.avoid[i];
        const double ratio = radius / ref::frame_of(mesh, params).unit;
        avoided.push_back({{center.face, center.weights[1], center.weights[2]},
                           static_cast<Real>(static_cast<float>(ratio)),
                           params.avoid_classes.empty() ? kAllClasses : params.avoid_classes[i]});
    }
    const ref::RunResult result =
        ref::throw_darts<Real>(surface, pool, ref::frame_of(mesh, params).tolerances(error_bound),
                               params.stop_count != 0 ? params.stop_count : kMaxCandidates, given,
                               avoided, params.existing_classes);
    for (const std::uint32_t rank : result.ranks) {
        const ref::FacePoint<Real> point = pool.candidate(rank);
        points.push_back(
            {point.face, static_cast<float>(point.weight1), static_cast<float>(point.weight2)});
        if (classes != nullptr) {
            classes->push_back(static_cast<std::uint8_t>(pool.word(rank) % 8));
        }
    }
    return points;
}

} // namespace

Points float_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                 std::vector<std::uint8_t>& classes) {
    classes.assign(params.existing_classes.begin(), params.existing_classes.end());
    classes.resize(params.existing.size(), 0);
    return sequential_set<float>(mesh, params, error_bound, nullptr, &classes);
}

Points float_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    return sequential_set<float>(mesh, params, error_bound);
}

Points listed_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                  const Points& candidates) {
    return sequential_set<float>(mesh, params, error_bound, &candidates);
}

Points double_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    return sequential_set<double>(mesh, params, error_bound);
}

Points set_after(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                 const Points& settled) {
    const std::vector<Sample> given = samples_of(settled);
    SampleParams with = params;
    with.existing = given;
    return float_set(mesh, with, error_bound);
}

Points points_of(const std::vector<ListedCandidate>& candidates) {
    Points points;
    for (const auto& [face, weight1, weight2] : candidates) {
        points.push_back(
            {face, static_cast<float>(weight1) * 0x1p-24f, static_cast<float>(weight2) * 0x1p-24f});
    }
    return points;
}

std::vector<Sample> samples_of(const Points& points) {
    std::vector<Sample> samples;
    for (const auto& [face, second, third] : points) {
        samples.push_back({face, {1 - second - third, second, third}});
    }
    return samples;
}

Points points_of(const SampleSet& set) {
    Points points;
    for (const Sample& s : set.samples) {
        points.push_back({s.face, s.weights[1], s.weights[2]});
    }
    return points;
}

SampleSet sample(const PreparedMesh& mesh, const SampleParams& params, RunnerOptions options) {
    Context& context = shared_context();
    Runner runner = expect(Runner::create(context.device(), context.queue(), options));
    return expect(runner.sample_and_wait(mesh, params));
}

SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed,
                        const RadiusField* radii) {
    SampleParams params;
    params.seed = seed;
    params.radii = radii;
    params.min_distance = distance_for_count(effective_area(mesh, params), count);
    return params;
}

Points ready_points(const DeviceRun& run) {
    Points points;
    for (const gpu::SampleRec& s :
         run.read<gpu::SampleRec>(BufferRole::samples, run.control().ready)) {
        points.push_back({s.face, s.weight1, s.weight2});
    }
    return points;
}

} // namespace geodisk::test
