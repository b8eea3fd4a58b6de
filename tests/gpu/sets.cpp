#include "sets.hpp"

#include "device_run.hpp"
#include "kernels/detect.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "throw_darts.hpp"

namespace geodisk::test {
namespace {

template <class Real>
Points sequential_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    expect(pool_size(mesh, params));
    const ref::Surface<Real> surface(mesh, params);
    const ref::Pool<Real> pool = ref::draw_pool(surface, params);
    const ref::RunResult result =
        ref::throw_darts(surface, pool, ref::frame_of(mesh, params).tolerances(error_bound),
                         params.stop_count != 0 ? params.stop_count : kMostCandidates);
    Points points;
    for (const std::uint32_t rank : result.ranks) {
        const ref::FacePoint<Real> point = pool.candidate(rank);
        points.push_back(
            {point.face, static_cast<float>(point.weight1), static_cast<float>(point.weight2)});
    }
    return points;
}

} // namespace

Points float_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    return sequential_set<float>(mesh, params, error_bound);
}

Points double_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    return sequential_set<double>(mesh, params, error_bound);
}

Points settled_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                   const Points& settled) {
    expect(pool_size(mesh, params));
    const ref::Surface<float> surface(mesh, params);
    const ref::Pool<float> pool = ref::draw_pool(surface, params);
    const auto tolerances = ref::frame_of(mesh, params).tolerances(error_bound);
    ref::Detector<float> detector(surface, pool.bins, tolerances, tolerances.limit);
    std::vector<bool> decided(pool.size());
    const auto reject = [&](const ref::FacePoint<float>& source) {
        detector.run(
            source, [&](std::uint32_t q) { return !decided[q]; },
            [&](std::uint32_t q, float) { decided[q] = true; });
    };
    Points points = settled;
    for (const SamplePoint& point : settled) {
        reject({point.face, point.weight1, point.weight2});
    }
    const std::size_t most = params.stop_count != 0 ? params.stop_count : kMostCandidates;
    for (std::uint32_t rank = 0; rank < pool.size() && points.size() < most; ++rank) {
        const std::uint32_t place = pool.places[rank];
        if (!decided[place]) {
            decided[place] = true;
            const ref::FacePoint<float> point = pool.candidate(rank);
            points.push_back({point.face, point.weight1, point.weight2});
            reject(point);
        }
    }
    return points;
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
