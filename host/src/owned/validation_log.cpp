#include "owned/validation_log.hpp"

namespace geodisk {
namespace {

// Limits the memory of an error inside a loop.
constexpr std::size_t kMaxKept = 256;

std::string text_of(const VkDebugUtilsMessengerCallbackDataEXT& data) {
    std::string text = data.pMessage != nullptr ? data.pMessage : "";
    if (data.pMessageIdName != nullptr && text.find(data.pMessageIdName) == std::string::npos)
        text = std::string(data.pMessageIdName) + ": " + text;
    return text;
}

} // namespace

VkDebugUtilsMessengerCreateInfoEXT ValidationLog::messenger_info() noexcept {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Not GENERAL: the loader reports broken drivers of other devices there.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = &ValidationLog::receive;
    info.pUserData = this;
    return info;
}

std::size_t ValidationLog::count() const noexcept {
    const std::lock_guard lock(mutex_);
    return count_;
}

std::vector<std::string> ValidationLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

VkBool32 ValidationLog::receive(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                const VkDebugUtilsMessengerCallbackDataEXT* data,
                                void* user) noexcept {
    ValidationLog& log = *static_cast<ValidationLog*>(user);
    {
        const std::lock_guard lock(log.mutex_);
        ++log.count_; // First, so that the count is right even if the text cannot be kept.
    }
    try {
        log.add(text_of(*data));
    } catch (...) { // Out of memory, or an exception of the user's callback. It must not reach the
                    // Vulkan code that called this.
    }
    return VK_FALSE;
}

void ValidationLog::add(const std::string& message) {
    {
        const std::lock_guard lock(mutex_);
        if (messages_.size() < kMaxKept)
            messages_.push_back(message);
    }
    if (on_message_) // Outside the lock, so that the callback may read the log.
        on_message_(message);
}

} // namespace geodisk
