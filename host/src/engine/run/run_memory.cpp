#include "engine/run/run_memory.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "support/try.hpp"
#include "vk/barriers.hpp"
#include "vk/debug.hpp"

namespace geodisk {
namespace {

constexpr VkDeviceSize kMinStaging = VkDeviceSize{64} << 10;
constexpr VkDeviceSize kMaxStaging = VkDeviceSize{16} << 20;
// Bytes for the control record.
constexpr VkDeviceSize kHeadBytes = 512;
static_assert(sizeof(gpu::ControlRec) <= kHeadBytes);
// Maximum bytes of samples that are read before their number is known.
constexpr VkDeviceSize kMaxReadAhead = VkDeviceSize{1} << 20;

/// Buffers that pending submissions may use.
struct InUse {
    const Submitter& submitter;
    std::array<DeviceBuffer, 3> buffers;
    ~InUse() {
        if (submitter.abandoned()) {
            for (DeviceBuffer& buffer : buffers) {
                buffer.abandon();
            }
        }
    }
};

} // namespace

RunMemory::~RunMemory() {
    if (submitter_.abandoned()) {
        staging_.abandon();
        for (DeviceBuffer& buffer : buffers_) {
            buffer.abandon();
        }
    }
}

Result<DeviceBuffer> RunMemory::create(const char* name, VkDeviceSize bytes,
                                       VkBufferUsageFlags usage, MemoryKind kind) {
    ++made_;
    auto made = DeviceBuffer::create(sampler_.device, sampler_.vk, memory_, bytes, usage, kind);
    if (made) {
        name_object(sampler_.vk, sampler_.device.device, VK_OBJECT_TYPE_BUFFER, made->handle(),
                    (std::string("geodisk ") + name).c_str());
    }
    was_short_ = !made && made.error().vk_result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return made;
}

std::uint64_t RunMemory::staging_bytes(std::uint64_t upload_bytes) {
    return std::clamp(kHeadBytes + upload_bytes, kMinStaging, kMaxStaging);
}

Result<Done> RunMemory::reserve_staging(VkDeviceSize bytes) {
    if (staging_.size() >= bytes) {
        return Done{};
    }
    staging_ = {};
    auto made = create("staging", bytes,
                       VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       MemoryKind::host);
    GEODISK_TRY(made);
    staging_ = std::move(*made);
    return Done{};
}

Result<Done> RunMemory::reserve(const WorkspaceNeeds& needs, VkDeviceSize staging_bytes) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (buffers_[i].size() >= needs.bytes[i]) {
            continue;
        }
        buffers_[i] = {};
        held_[i].clear();
        auto made = create(to_string(static_cast<BufferRole>(i)), needs.bytes[i]);
        GEODISK_TRY(made);
        buffers_[i] = std::move(*made);
    }
    return reserve_staging(staging_bytes);
}

void RunMemory::free_all() {
    for (DeviceBuffer& buffer : buffers_) {
        buffer = {};
    }
    held_ = {};
    staging_ = {};
}

std::uint64_t RunMemory::bytes_with(const WorkspaceNeeds& needs, VkDeviceSize staging_bytes) const {
    std::uint64_t sum = std::max(staging_.size(), staging_bytes);
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        sum += std::max(buffers_[i].size(), needs.bytes[i]);
    }
    return sum;
}

Result<Done> RunMemory::allocate(const WorkspaceNeeds& needs, std::uint64_t upload_bytes,
                                 std::uint64_t most) {
    uploads_.clear();
    staged_ = 0;
    const VkDeviceSize staging = staging_bytes(upload_bytes);
    if (bytes_with(needs, staging) > most) {
        free_all();
    }
    const bool had_any = bytes() > 0;
    auto reserved = reserve(needs, staging);
    if (!reserved && reserved.error().status == Status::out_of_device_memory && had_any) {
        free_all();
        reserved = reserve(needs, staging);
    }
    const VkDeviceSize all = staging_.size() - std::min(staging_.size(), kHeadBytes);
    stage_begin_ = kHeadBytes;
    stage_bytes_ = upload_bytes <= all ? all : all / 2;
    return reserved;
}

BufferRange RunMemory::range(BufferRole role) const {
    return {buffer(role).handle(), 0, buffer(role).size()};
}

Workspace RunMemory::workspace() const {
    Workspace ranges;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        ranges[i] = range(static_cast<BufferRole>(i));
    }
    return ranges;
}

std::uint64_t RunMemory::bytes() const {
    std::uint64_t sum = staging_.size();
    for (const DeviceBuffer& buffer : buffers_) {
        sum += buffer.size();
    }
    return sum;
}

bool RunMemory::holds(BufferRole role, const std::vector<std::uint64_t>& meshes) const {
    return held_[static_cast<std::size_t>(role)] == meshes;
}

void RunMemory::set_held(BufferRole role, const std::vector<std::uint64_t>& meshes) {
    held_[static_cast<std::size_t>(role)] = meshes;
}

std::span<std::byte> RunMemory::stage(BufferRole role, VkDeviceSize to, std::size_t size) {
    const VkDeviceSize from = stage_begin_ + staged_;
    uploads_.push_back({role, from, to, size});
    staged_ += size;
    return staging_.bytes().subspan(from, size);
}

void RunMemory::record_uploads(VkCommandBuffer commands) {
    samples_ = 0;
    for (const Upload& upload : uploads_) {
        const VkBufferCopy copy{upload.from, upload.to, upload.size};
        sampler_.vk.vkCmdCopyBuffer(commands, staging_.handle(), buffer(upload.role).handle(), 1,
                                    &copy);
    }
    if (!uploads_.empty()) {
        barrier_transfer_to_compute(sampler_.vk, commands);
    }
    uploads_.clear();
    staged_ = 0;
    if (kHeadBytes + 2 * stage_bytes_ <= staging_.size()) {
        stage_begin_ = stage_begin_ == kHeadBytes ? kHeadBytes + stage_bytes_ : kHeadBytes;
    }
}

Task<Result<Done>> RunMemory::upload(BufferRole role, VkDeviceSize to,
                                     std::span<const std::byte> bytes) {
    const DeviceTable& vk = sampler_.vk;
    for (std::size_t done = 0; done < bytes.size();) {
        const std::size_t part = std::min(bytes.size() - done, staging_.bytes().size());
        std::memcpy(staging_.bytes().data(), bytes.data() + done, part);
        auto copied = submitter_.submit([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, to + done, part};
            vk.vkCmdCopyBuffer(commands, staging_.handle(), buffer(role).handle(), 1, &copy);
            barrier_transfer_to_compute(vk, commands);
        });
        if (copied) {
            copied = co_await submitter_.ended();
        }
        if (!copied) {
            co_return copied;
        }
        done += part;
    }
    co_return Done{};
}

Task<Result<Done>> RunMemory::read(BufferRole role, std::span<std::byte> bytes, VkDeviceSize from) {
    const DeviceTable& vk = sampler_.vk;
    for (std::size_t done = 0; done < bytes.size();) {
        const std::size_t part = std::min(bytes.size() - done, staging_.bytes().size());
        auto copied = submitter_.submit([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{from + done, 0, part};
            vk.vkCmdCopyBuffer(commands, buffer(role).handle(), staging_.handle(), 1, &copy);
            barrier_transfer_to_host(vk, commands);
        });
        if (copied) {
            copied = co_await submitter_.ended();
        }
        if (!copied) {
            co_return copied;
        }
        std::memcpy(bytes.data() + done, staging_.bytes().data(), part);
        done += part;
    }
    co_return Done{};
}

void RunMemory::record_samples(VkCommandBuffer commands, VkDeviceSize bytes) {
    if (bytes > std::min(staging_.size() - kHeadBytes, kMaxReadAhead)) {
        return;
    }
    barrier_compute_to_transfer(sampler_.vk, commands);
    const VkBufferCopy copy{0, kHeadBytes, bytes};
    sampler_.vk.vkCmdCopyBuffer(commands, buffer(BufferRole::samples).handle(), staging_.handle(),
                                1, &copy);
    samples_ = bytes;
}

std::span<const std::byte> RunMemory::samples() const {
    return staging_.bytes().subspan(kHeadBytes, samples_);
}

void RunMemory::record_control(VkCommandBuffer commands) const {
    const DeviceTable& vk = sampler_.vk;
    barrier_compute_to_transfer(vk, commands);
    const VkBufferCopy copy{0, 0, sizeof(gpu::ControlRec)};
    vk.vkCmdCopyBuffer(commands, buffer(BufferRole::control).handle(), staging_.handle(), 1, &copy);
    barrier_transfer_to_host(vk, commands);
}

gpu::ControlRec RunMemory::control() const {
    gpu::ControlRec control;
    std::memcpy(&control, staging_.bytes().data(), sizeof control);
    return control;
}

Result<Done> RunMemory::enlarge_pool(VkDeviceSize bytes) {
    if (bytes > buffer(BufferRole::pool).size()) {
        buffer(BufferRole::pool) = {}; // Free the old pool first, so that there are never two.
        auto larger = create(to_string(BufferRole::pool), bytes);
        GEODISK_TRY(larger);
        buffer(BufferRole::pool) = std::move(*larger);
    }
    return Done{};
}

Task<Result<Done>> RunMemory::enlarge_samples(std::array<VkDeviceSize, 3> bytes, std::uint32_t kept,
                                              std::uint64_t most) {
    constexpr std::array kRoles{BufferRole::samples, BufferRole::accepted, BufferRole::buckets};
    constexpr std::size_t kHeld = 2; // The contents of the buckets are not needed any more.
    const std::size_t kept_bytes = std::size_t{kept} * sizeof(gpu::SampleRec);
    const bool by_host = kept > 0 && this->bytes() + bytes[0] + bytes[1] + bytes[2] > most;
    std::array<std::vector<std::byte>, kHeld> copies;
    InUse larger{submitter_, {}};
    if (by_host || kept == 0) {
        for (std::size_t i = 0; i < kHeld && by_host; ++i) {
            copies[i].resize(kept_bytes);
            if (auto copied = co_await read(kRoles[i], copies[i]); !copied) {
                co_return copied;
            }
        }
        for (const BufferRole role : kRoles) {
            buffer(role) = {};
        }
    }
    for (std::size_t i = 0; i < kRoles.size(); ++i) {
        auto allocated = create(to_string(kRoles[i]), bytes[i]);
        GEODISK_CO_TRY(allocated);
        larger.buffers[i] = std::move(*allocated);
    }
    if (kept > 0 && !by_host) {
        const DeviceTable& vk = sampler_.vk;
        auto copied = submitter_.submit([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, 0, kept_bytes};
            for (std::size_t i = 0; i < kHeld; ++i) {
                vk.vkCmdCopyBuffer(commands, buffer(kRoles[i]).handle(), larger.buffers[i].handle(),
                                   1, &copy);
            }
            barrier_transfer_to_compute(vk, commands);
        });
        if (copied) {
            copied = co_await submitter_.ended();
        }
        if (!copied) {
            co_return copied;
        }
    }
    for (std::size_t i = 0; i < kRoles.size(); ++i) {
        buffer(kRoles[i]) = std::move(larger.buffers[i]);
    }
    for (std::size_t i = 0; i < kHeld && by_host; ++i) {
        if (auto copied = co_await upload(kRoles[i], 0, copies[i]); !copied) {
            co_return copied;
        }
    }
    co_return Done{};
}

} // namespace geodisk
