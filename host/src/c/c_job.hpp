// Jobs of the C API: runs that the caller records.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/geodisk.h>
#include <geodisk/sampler.hpp>

#include "c/c_call.hpp"
#include "c/c_device.hpp"
#include "c/c_domain.hpp"
#include "records.h"

namespace geodisk::c {

/// Makes the error for calls before geodisk_job_bind.
Error needs_buffers();

/// Converts a range.
BufferRange range_of(const geodisk_buffer_range& given) noexcept;

} // namespace geodisk::c

struct geodisk_job {
    std::shared_ptr<const geodisk::c::Device> device;
    std::shared_ptr<const geodisk::Sampler> sampler;
    std::shared_ptr<const geodisk::c::DomainState> domain;
    std::uint64_t pool_bytes = 0;
    std::uint32_t stages = 0; ///< Stages drawn at once, or 0.
    std::uint32_t regrowths = 0;
    std::optional<std::uint64_t> seed; ///< Seed that replaces the domain's.
    std::uint64_t end_order = geodisk::kAllOrders;
    /// Existing samples that replace those of the domain.
    std::optional<std::vector<geodisk::gpu::SampleRec>> settled;

    geodisk::RunPlan plan; ///< Plan to continue with, once there are buffers for it.
    std::uint32_t sample_capacity = 0;
    std::uint32_t ready = 0; ///< Latest value from geodisk_job_advance.
    std::array<std::uint64_t, geodisk::kBufferRoles> needed{};
    geodisk::Workspace workspace{};
    std::optional<geodisk::Job> recorded; ///< Set once buffers are bound.

    /// Step that needs new buffers: GEODISK_LARGER_POOL, GEODISK_LARGER_SAMPLES, or
    /// GEODISK_START_OVER as for a new job.
    std::optional<geodisk_next> to_bind = GEODISK_START_OVER;
    /// Step that has its buffers and must be recorded: GEODISK_LARGER_POOL or
    /// GEODISK_LARGER_SAMPLES.
    std::optional<geodisk_next> to_record;
    bool is_begun = false; ///< True if begun with these buffers and this seed.
    std::array<bool, geodisk::kBufferRoles> uploaded{}; ///< True if the upload was written for
                                                        ///< these buffers.

    std::atomic<bool> is_held = false; ///< True while a call uses it.

    /// Returns true if it has buffers for its domain, even if some must become larger.
    bool is_bound() const { return to_bind != GEODISK_START_OVER; }
};

namespace geodisk::c {

/// Plans a run of a domain with room for so many more existing samples. An error changes nothing.
Result<Done> plan_domain(geodisk_job& job, std::shared_ptr<const DomainState> state,
                         std::size_t settled);
Result<std::unique_ptr<geodisk_job>> make_job(const geodisk_device& device,
                                              const geodisk_domain& domain,
                                              const geodisk_job_options& options);
/// Asks for all buffers and restarts.
void start_over(geodisk_job& job);
Result<Done> bind(geodisk_job& job, const geodisk_buffer_range* ranges);
/// Bytes to upload into a buffer: those of the domain, and the existing samples.
std::size_t upload_bytes(const geodisk_job& job, BufferRole role);
Result<Done> write_upload(const geodisk_job& job, BufferRole role, std::span<std::byte> out);
/// As geodisk_job_record; returns true if everything is recorded.
Result<bool> record(geodisk_job& job, VkCommandBuffer commands, geodisk_next what,
                    std::uint32_t amount);
Result<geodisk_advice> advise(geodisk_job& job, const gpu::ControlRec& control);

/// Runs `body(*job)` unless another call uses the job.
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
