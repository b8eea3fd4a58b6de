// The jobs of the C API: runs that the caller records.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include <geodisk/geodisk.h>
#include <geodisk/sampler.hpp>

#include "c/c_call.hpp"
#include "c/c_device.hpp"
#include "c/c_domain.hpp"

namespace geodisk::c {

/// A failure for calls that come before geodisk_job_bind.
Error needs_buffers();

/// A range as C++ has it.
BufferRange range_of(const geodisk_buffer_range& given) noexcept;

} // namespace geodisk::c

struct geodisk_job {
    std::shared_ptr<const geodisk::c::Device> device;
    std::shared_ptr<const geodisk::Sampler> sampler;
    std::shared_ptr<const geodisk::c::DomainState> domain;
    std::uint64_t pool_bytes = 0;
    std::uint32_t stages = 0; ///< At once, or 0.
    std::uint32_t regrowths = 0;
    std::optional<std::uint64_t> seed; ///< Another than the domain's.

    geodisk::RunPlan plan; ///< To go on with, once there are buffers for it.
    std::uint32_t sample_capacity = 0;
    std::uint32_t ready = 0; ///< As geodisk_job_advance said last.
    std::array<std::uint64_t, geodisk::kBufferRoles> needed{};
    geodisk::Workspace workspace{};
    std::optional<geodisk::Job> recorded; ///< Once it has buffers.

    /// What the buffers are to be bound for, if they are: larger_pool, larger_samples, or
    /// start_over, as at first.
    std::optional<geodisk::Next> to_bind = geodisk::Next::start_over;
    /// What has been bound for and is to be recorded: larger_pool or larger_samples.
    std::optional<geodisk::Next> to_record;
    bool is_begun = false;                              ///< With these buffers and this seed.
    std::array<bool, geodisk::kBufferRoles> uploaded{}; ///< Written for these buffers.

    std::atomic<bool> is_held = false; ///< A call has it.

    /// Whether it has buffers for its domain, though maybe some that are to become larger.
    bool is_bound() const { return to_bind != geodisk::Next::start_over; }
};

namespace geodisk::c {

/// Runs `body(*job)` with a job that no other call has.
template <class Body>
geodisk_status with_job(geodisk_job* job, geodisk_error* error, const Body& body) {
    return answer(error, [&]() -> Result<Done> {
        if (job == nullptr) {
            return wrong("job is NULL");
        }
        return hold(job->is_held, "the job", [&]() -> Result<Done> { return body(*job); });
    });
}

} // namespace geodisk::c
