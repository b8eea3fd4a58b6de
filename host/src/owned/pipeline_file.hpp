// A file that keeps the contents of a Vulkan pipeline cache for later processes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace geodisk {

/// Returns geodisk's folder in the user's cache folder. Returns nothing if GEODISK_CACHE is "off"
/// or the environment names no such folder. The folder may not exist. May throw std::bad_alloc.
std::optional<std::filesystem::path> cache_folder();

/// The file of one device, driver and version of geodisk. Several processes may use it at once. No
/// function reports an error: without the file, the driver only compiles again. Functions may
/// throw std::bad_alloc.
class PipelineFile {
  public:
    PipelineFile(const std::filesystem::path& folder, const VkPhysicalDeviceProperties& device);

    const std::filesystem::path& path() const noexcept { return path_; }

    /// Returns the contents to create a cache with. They are empty if there is no file, or if it
    /// is damaged or belongs to another device, driver or version.
    std::vector<std::byte> load() const;

    /// Replaces the file, unless that is not possible. Creates the folder.
    void store(std::span<const std::byte> contents) const;

  private:
    std::filesystem::path path_;
    std::vector<std::byte> identity_; ///< First bytes of the file.
    VkPhysicalDeviceProperties device_;
};

} // namespace geodisk
