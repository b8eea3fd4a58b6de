#include <geodisk/box.hpp>

#include <string>
#include <utility>

#include "engine/box_source.hpp"
#include "engine/run.hpp"
#include "support/guard.hpp"

namespace geodisk {

BoxRunner::BoxRunner(std::unique_ptr<Runner::Impl> impl) noexcept : impl_(std::move(impl)) {}
BoxRunner::BoxRunner(BoxRunner&&) noexcept = default;
BoxRunner& BoxRunner::operator=(BoxRunner&&) noexcept = default;
BoxRunner::~BoxRunner() = default;

std::uint32_t BoxRunner::dimension() const noexcept {
    return impl_->engine().dimension;
}
const DeviceReport& BoxRunner::report() const noexcept {
    return impl_->sampler.report();
}
const Tuning& BoxRunner::tuning() const noexcept {
    return impl_->sampler.tuning();
}

Result<BoxRunner> BoxRunner::create(const DeviceRefs& device, const QueueRef& queue,
                                    std::uint32_t dimension,
                                    const RunnerOptions& options) noexcept {
    return guarded([&]() -> Result<BoxRunner> {
        if (dimension < 1 || dimension > kMostBoxDimensions) {
            return Error{Status::invalid_argument,
                         "the dimension must be 1 to 6, not " + std::to_string(dimension)};
        }
        auto impl = Runner::Impl::create(
            Sampler::Impl::create_for(Domain::box, dimension, device, options.sampler), queue,
            options);
        if (!impl) {
            return impl.error();
        }
        return BoxRunner(std::move(*impl));
    });
}

Result<BoxSampleSet> BoxRunner::sample_and_wait(const BoxParams& box,
                                                const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<BoxSampleSet> {
        if (auto checked = pool_size(box); !checked) {
            return checked.error();
        }
        if (box.extents.size() != dimension()) {
            return Error{Status::invalid_argument,
                         "the box has " + std::to_string(box.extents.size()) +
                             " sides, and the runner was made for " + std::to_string(dimension())};
        }
        const auto result = run_and_wait(
            *impl_, BoxSource(impl_->engine(), box, impl_->memory_for_candidates()), progress);
        if (!result) {
            return result.error();
        }
        BoxSampleSet set{dimension(), {}, result->report};
        set.points.resize(result->samples.size() * dimension());
        const DrawAxes axes = draw_axes(box);
        for (std::size_t i = 0; i < result->samples.size(); ++i) {
            sample_point(box.seed, axes, result->samples[i],
                         std::span(set.points).subspan(i * dimension(), dimension()));
        }
        return set;
    });
}

} // namespace geodisk
