#include "owned/pipeline_file.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include <geodisk/detail/cache_folder.hpp>
#include <geodisk/detail/fnv1a.hpp>
#include <geodisk/version.hpp>

#include "support/checksums.hpp"

namespace geodisk {
namespace {

constexpr std::string_view kMagic = "geodisk pipelines 1\n";

/// More than any driver makes of geodisk's kernels. Protects from reading a file of nonsense.
constexpr std::streamoff kMaxBytes = std::streamoff{256} << 20;

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    const auto* const first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

std::uint64_t hash_of(std::span<const std::byte> bytes) {
    detail::Fnv1a hash;
    for (const std::byte byte : bytes) {
        hash.add(static_cast<std::uint64_t>(byte));
    }
    return hash.value();
}

/// Returns what tells the device, driver and version of geodisk from others.
std::vector<std::byte> identity_of(const VkPhysicalDeviceProperties& device) {
    std::vector<std::byte> bytes;
    for (const char c : kMagic) {
        append(bytes, c);
    }
    for (const std::uint32_t number :
         {std::uint32_t{GEODISK_VERSION_MAJOR}, std::uint32_t{GEODISK_VERSION_MINOR},
          std::uint32_t{GEODISK_VERSION_PATCH}, device.vendorID, device.deviceID,
          device.driverVersion, static_cast<std::uint32_t>(sizeof(void*))}) {
        append(bytes, number);
    }
    append(bytes, device.pipelineCacheUUID);
    return bytes;
}

/// Returns true if Vulkan allows to create a cache of the device with the contents.
bool is_of_device(std::span<const std::byte> contents, const VkPhysicalDeviceProperties& device) {
    VkPipelineCacheHeaderVersionOne header{};
    if (contents.size() < sizeof header) {
        return false;
    }
    std::memcpy(&header, contents.data(), sizeof header);
    std::uint32_t version = 0; // As a number, since the file may have any.
    std::memcpy(&version,
                contents.data() + offsetof(VkPipelineCacheHeaderVersionOne, headerVersion),
                sizeof version);
    return header.headerSize >= sizeof header && header.headerSize <= contents.size() &&
           version == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == device.vendorID &&
           header.deviceID == device.deviceID &&
           std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

} // namespace

std::optional<std::filesystem::path> cache_folder() {
    const char* const wanted = std::getenv("GEODISK_CACHE");
    if (wanted != nullptr && std::string_view(wanted) == "off") {
        return std::nullopt;
    }
    std::filesystem::path folder = detail::cache_folder();
    return folder.empty() ? std::nullopt : std::optional(std::move(folder));
}

PipelineFile::PipelineFile(const std::filesystem::path& folder,
                           const VkPhysicalDeviceProperties& device)
    : identity_(identity_of(device)), device_(device) {
    path_ = folder / ("pipelines-" + detail::hexadecimal(hash_of(identity_)));
}

std::vector<std::byte> PipelineFile::load() const {
    std::ifstream in(path_, std::ios::binary); // Opened first: another process may replace it.
    in.seekg(0, std::ios::end);
    const std::streamoff bytes = in.tellg();
    const std::size_t before = identity_.size() + sizeof(std::uint64_t);
    if (!in || bytes < static_cast<std::streamoff>(before) || bytes > kMaxBytes) {
        return {};
    }
    std::vector<std::byte> file(static_cast<std::size_t>(bytes));
    in.seekg(0);
    if (!in.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(file.size()))) {
        return {};
    }
    const std::span<const std::byte> contents = std::span(file).subspan(before);
    std::uint64_t hash = 0;
    std::memcpy(&hash, file.data() + identity_.size(), sizeof hash);
    if (std::memcmp(file.data(), identity_.data(), identity_.size()) != 0 ||
        (kComparesChecksums && hash != hash_of(contents)) || !is_of_device(contents, device_)) {
        return {};
    }
    return {contents.begin(), contents.end()};
}

void PipelineFile::store(std::span<const std::byte> contents) const {
    std::error_code error;
    std::filesystem::create_directories(path_.parent_path(), error);
    std::filesystem::path temporary = path_;
    std::random_device random;
    temporary += "." + detail::hexadecimal(std::uint64_t{random()} << 32 | random()) + ".tmp";
    {
        std::ofstream out(temporary, std::ios::binary);
        const std::uint64_t hash = hash_of(contents);
        out.write(reinterpret_cast<const char*>(identity_.data()),
                  static_cast<std::streamsize>(identity_.size()));
        out.write(reinterpret_cast<const char*>(&hash), sizeof hash);
        out.write(reinterpret_cast<const char*>(contents.data()),
                  static_cast<std::streamsize>(contents.size()));
        out.close();
        if (out) {
            std::filesystem::rename(temporary, path_, error);
            if (!error) {
                return;
            }
        }
    }
    std::filesystem::remove(temporary, error);
}

} // namespace geodisk
