// Collects messages of the validation layer.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk {

/// Log of messages of severity warning or higher. Thread-safe.
class ValidationLog {
  public:
    explicit ValidationLog(std::function<void(std::string_view)> on_message)
        : on_message_(std::move(on_message)) {}

    /// Returns the description of a messenger that reports to this log. The log must outlive the
    /// messenger and the instance.
    VkDebugUtilsMessengerCreateInfoEXT messenger_info() noexcept;

    std::size_t count() const noexcept;
    std::vector<std::string> messages() const;

  private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user) noexcept;
    void add(const std::string& message);

    std::function<void(std::string_view)> on_message_;
    mutable std::mutex mutex_;
    std::size_t count_ = 0;
    std::vector<std::string> messages_;
};

} // namespace geodisk
