#include "owned/pipeline_cache.hpp"

#include <exception>
#include <utility>

namespace geodisk {

void PipelineCache::open(VkDevice device, PFN_vkGetDeviceProcAddr get_device_proc_addr,
                         PipelineFile file) {
    const auto create = reinterpret_cast<PFN_vkCreatePipelineCache>(
        get_device_proc_addr(device, "vkCreatePipelineCache"));
    get_data_ = reinterpret_cast<PFN_vkGetPipelineCacheData>(
        get_device_proc_addr(device, "vkGetPipelineCacheData"));
    destroy_ = reinterpret_cast<PFN_vkDestroyPipelineCache>(
        get_device_proc_addr(device, "vkDestroyPipelineCache"));
    if (create == nullptr || get_data_ == nullptr || destroy_ == nullptr) {
        return;
    }
    device_ = device;
    loaded_ = file.load();
    file_.emplace(std::move(file));
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    info.initialDataSize = loaded_.size();
    info.pInitialData = loaded_.data();
    VkPipelineCache cache = VK_NULL_HANDLE;
    if (create(device, &info, nullptr, &cache) == VK_SUCCESS) {
        handle_ = cache;
    }
}

void PipelineCache::write_file() const {
    std::size_t bytes = 0;
    if (get_data_(device_, handle_, &bytes, nullptr) != VK_SUCCESS || bytes == 0) {
        return;
    }
    std::vector<std::byte> contents(bytes);
    if (get_data_(device_, handle_, &bytes, contents.data()) != VK_SUCCESS) {
        return;
    }
    contents.resize(bytes);
    if (contents != loaded_) {
        file_->store(contents);
    }
}

void PipelineCache::close() noexcept {
    if (handle_ == VK_NULL_HANDLE) {
        return;
    }
    try {
        write_file();
    } catch (const std::exception&) {
        // The next process compiles again.
    }
    destroy_(device_, handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
}

} // namespace geodisk
