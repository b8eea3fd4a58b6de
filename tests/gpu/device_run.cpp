#include "device_run.hpp"

#include <stdexcept>

#include "engine/plan.hpp"
#include "vk/barriers.hpp"

namespace geodisk::test {
namespace {

SamplerOptions options_for(SamplerOptions options, const SampleParams& params) {
    options.adaptive = params.radii != nullptr;
    return options;
}

void barrier_to_host(const DeviceTable& vk, VkCommandBuffer commands) {
    record_barrier(vk, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                   VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

} // namespace

Context& shared_context() {
    static Context context = expect(Context::create());
    return context;
}

DeviceRun::DeviceRun(const PreparedMesh& mesh, const SampleParams& params, const RunPlan& plan,
                     const SamplerOptions& options, const Context& context)
    : device_(context.device()), vk_(expect(load_device_table(device_))),
      sampler_(expect(Sampler::create(device_, options_for(options, params)))) {
    submitter_.emplace(
        expect(Submitter::create(device_, vk_, context.queue(), std::chrono::seconds(300))));
    const auto instance =
        expect(load_instance_table(device_.get_instance_proc_addr, device_.instance));
    instance.vkGetPhysicalDeviceMemoryProperties(device_.physical_device, &memory_);
    RunPlan used = expect(sampler_->plan_run(mesh, params, std::uint64_t{64} << 20));
    used = overridden(used, plan);
    const WorkspaceNeeds needs = expect(sampler_->workspace_needs(mesh, params, used));
    Workspace workspace;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        buffers_[i] = expect(DeviceBuffer::create(device_, vk_, memory_, needs.bytes[i],
                                                  kWorkspaceUsage, MemoryKind::host));
        workspace[i] = {buffers_[i].handle(), 0, buffers_[i].size()};
    }
    for (const BufferRole role : {BufferRole::faces, BufferRole::fans, BufferRole::alias}) {
        const auto bytes = buffers_[static_cast<std::size_t>(role)].bytes();
        expect(sampler_->mesh_bytes(mesh, params, role,
                                    bytes.first(sampler_->mesh_bytes_size(mesh, role))));
    }
    job_.emplace(expect(sampler_->make_job(mesh, params, used, workspace)));
}

void DeviceRun::begin() {
    expect(submitter_->run([&](VkCommandBuffer commands) {
        sampler_->record_begin(commands, *job_);
        barrier_to_host(vk_, commands);
    }));
}

void DeviceRun::rounds(std::uint32_t count) {
    expect(submitter_->run([&](VkCommandBuffer commands) {
        sampler_->record_rounds(commands, *job_, count);
        barrier_to_host(vk_, commands);
    }));
}

void DeviceRun::grow(std::uint32_t overflow) {
    const std::uint64_t pool = buffers_[static_cast<std::size_t>(BufferRole::pool)].size();
    expect(job_->set_plan(expect(sampler_->grow_plan(job_->plan(), overflow, pool))));
    expect(submitter_->run([&](VkCommandBuffer commands) {
        sampler_->record_rewind(commands, *job_);
        barrier_to_host(vk_, commands);
    }));
}

void DeviceRun::enlarge_samples(std::uint32_t count) {
    DeviceBuffer& samples = buffers_[static_cast<std::size_t>(BufferRole::samples)];
    samples = expect(DeviceBuffer::create(device_, vk_, memory_, count * sizeof(gpu::SampleRec),
                                          kWorkspaceUsage, MemoryKind::host));
    expect(job_->set_samples({samples.handle(), 0, samples.size()}));
}

void DeviceRun::finish() {
    expect(submitter_->run([&](VkCommandBuffer commands) {
        sampler_->record_finish(commands, *job_);
        barrier_to_host(vk_, commands);
    }));
}

} // namespace geodisk::test
