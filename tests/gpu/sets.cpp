#include "sets.hpp"

#include "device_run.hpp"
#include "kernels/candidates.hpp"
#include "run.hpp"

namespace geodisk::test {
namespace {

template <class Real>
std::vector<std::uint32_t> sequential_set(const PreparedMesh& mesh, const SampleParams& params,
                                          std::uint32_t chain) {
    const ref::Surface<Real> surface(mesh, params.min_distance);
    const auto points = ref::draw_candidates<Real>(mesh.alias_columns(), params.seed,
                                                   expect(pool_size(mesh, params)));
    const ref::Bins<Real> bins(surface, points);
    return ref::throw_darts(surface, bins, tolerances_for(mesh, params.min_distance, chain),
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

SampleSet sample(const PreparedMesh& mesh, const SampleParams& params,
                 const RunnerOptions& options) {
    Context& context = shared_context();
    Runner runner = expect(Runner::create(context.device(), context.queue(), options));
    return expect(runner.sample_and_wait(mesh, params));
}

SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.statistics().area, count);
    params.seed = seed;
    return params;
}

} // namespace geodisk::test
