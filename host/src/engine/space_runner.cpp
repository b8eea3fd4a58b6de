#include <geodisk/space.hpp>

#include <string>
#include <utility>

#include "engine/run.hpp"
#include "engine/space_source.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

// At a box of a million distances.
constexpr double kWidestGuard = 0x1p-10;

Result<Done> check_view(const MeshView& view, const PreparedMesh& mesh) {
    if (view.dimension != 3) {
        return Error{Status::invalid_argument,
                     "straight-line distances need three coordinates per vertex, not " +
                         std::to_string(view.dimension)};
    }
    if (view.triangles.size() != std::size_t{3} * mesh.face_count() ||
        view.positions.size() != std::size_t{3} * mesh.vertex_count()) {
        return Error{Status::invalid_argument, "the view is not of the mesh that was prepared"};
    }
    return Done{};
}

} // namespace

SpaceRunner::SpaceRunner(std::unique_ptr<Runner::Impl> impl) noexcept : impl_(std::move(impl)) {}
SpaceRunner::SpaceRunner(SpaceRunner&&) noexcept = default;
SpaceRunner& SpaceRunner::operator=(SpaceRunner&&) noexcept = default;
SpaceRunner::~SpaceRunner() = default;

const Tuning& SpaceRunner::tuning() const noexcept {
    return impl_->sampler.tuning();
}

Result<SpaceRunner> SpaceRunner::create(const DeviceRefs& device, const QueueRef& queue,
                                        Metric metric, const RunnerOptions& options) noexcept {
    return guarded([&]() -> Result<SpaceRunner> {
        auto impl = Runner::Impl::create(Sampler::Impl::create_for(Domain::space, 3, device,
                                                                   options.sampler,
                                                                   metric == Metric::approximate),
                                         queue, options);
        if (!impl) {
            return impl.error();
        }
        return SpaceRunner(std::move(*impl));
    });
}

Result<SampleSet> SpaceRunner::sample_and_wait(const MeshView& view, const PreparedMesh& mesh,
                                               const SampleParams& params,
                                               const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SampleSet> {
        if (auto checked = pool_size(mesh, params); !checked) {
            return checked.error();
        }
        if (params.radii != nullptr) {
            return Error{Status::invalid_argument,
                         "SampleParams::radii is for geodesic distances alone"};
        }
        if (auto checked = check_view(view, mesh); !checked) {
            return checked.error();
        }
        const SpaceSource source(impl_->engine(), view, mesh, params,
                                 impl_->memory_for_candidates());
        if (!(source.guard({}) <= kWidestGuard)) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small beside the bounding box of the mesh"};
        }
        auto result = run_and_wait(*impl_, source, progress);
        if (!result) {
            return result.error();
        }
        return to_samples(*result);
    });
}

} // namespace geodisk
