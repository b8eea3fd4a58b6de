#include "sets.hpp"

#include "device_run.hpp"
#include "kernels/candidates.hpp"
#include "run.hpp"

namespace geodisk::test {
namespace {

template <class Real>
std::vector<std::uint32_t> sequential_set(const PreparedMesh& mesh, const SampleParams& params,
                                          std::uint32_t chain) {
    const ref::Surface<Real> surface(mesh, params);
    const auto points = ref::draw_candidates(surface, params.seed, expect(pool_size(mesh, params)));
    const ref::Bins<Real> bins(surface, points);
    return ref::throw_darts(surface, bins, tolerances_for(mesh, params, chain),
                            params.stop_count != 0 ? params.stop_count : kMostCandidates)
        .ranks;
}

} // namespace

std::vector<std::uint32_t> float_set(const PreparedMesh& mesh, const SampleParams& params,
                                     std::uint32_t chain) {
    return sequential_set<float>(mesh, params, chain);
}

std::vector<std::uint32_t> double_set(const PreparedMesh& mesh, const SampleParams& params,
                                      std::uint32_t chain) {
    return sequential_set<double>(mesh, params, chain);
}

std::vector<std::uint32_t> ranks_of(const SampleSet& set) {
    std::vector<std::uint32_t> ranks;
    for (const Sample& s : set.samples) {
        ranks.push_back(s.candidate);
    }
    return ranks;
}

SampleSet sample(const PreparedMesh& mesh, const SampleParams& params, RunnerOptions options) {
    Context& context = shared_context();
    options.sampler.adaptive = params.radii != nullptr;
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

} // namespace geodisk::test
