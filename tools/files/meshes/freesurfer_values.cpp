#include <cstddef>
#include <cstdint>
#include <string>

#include "files/byte_order.hpp"
#include "files/meshes/value_files.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kValuesMagic = "\xff\xff\xff";

} // namespace

bool is_freesurfer_values(std::string_view bytes) {
    return bytes.starts_with(kValuesMagic);
}

/// Behind the magic number: the numbers of vertices, faces and values of each, and the values.
std::vector<double> read_freesurfer_values(const Path& path, std::string_view bytes) {
    constexpr std::size_t kSize = sizeof(float), kHead = kValuesMagic.size() + 3 * kSize;
    constexpr bool kHighestFirst = false;
    if (bytes.size() < kHead) {
        fail_input(path, "ends within the head of a FreeSurfer file of values");
    }
    const auto word = [&](std::size_t i) {
        return value_of_bytes<std::uint32_t>(bytes.data() + kValuesMagic.size() + i * kSize,
                                             kHighestFirst);
    };
    if (word(2) != 1) {
        fail_input(path,
                   "has " + counted(word(2), "value", "values") + " for each vertex; one is read");
    }
    const std::size_t count = word(0);
    if ((bytes.size() - kHead) / kSize < count) {
        fail_input(path, "ends after " + grouped((bytes.size() - kHead) / kSize) + " of " +
                             counted(count, "value", "values"));
    }
    std::vector<double> values(count);
    const char* at = bytes.data() + kHead;
    for (double& value : values) {
        value = value_of_bytes<float>(at, kHighestFirst);
        at += kSize;
    }
    return values;
}

} // namespace geodisk::tools
