#include "engine/run/frame_growth.hpp"

#include "engine/job/sampler_impl.hpp"

namespace geodisk {

Result<FrameAdvice> advance_or_grow(Job& job, const gpu::ControlRec& control,
                                    std::uint64_t& pool_bytes, const DeviceReport& report) {
    Job::Impl& own = Job::Impl::of(job);
    auto advice = own.advance(control, 0, LastResort::none);
    const bool outgrown = !advice && advice.error().status == Status::workspace_too_small;
    for (bool is_last = !outgrown; !is_last; pool_bytes *= 2) {
        is_last = pool_bytes >= report.limits.max_storage_buffer_range;
        advice = own.advance(control, pool_bytes, is_last ? LastResort::lanes : LastResort::none);
        is_last = is_last || advice || advice.error().status != Status::workspace_too_small;
        if (is_last) {
            break;
        }
    }
    return advice ? Result<FrameAdvice>(FrameAdvice{*advice, outgrown})
                  : Result<FrameAdvice>(advice.error());
}

} // namespace geodisk
