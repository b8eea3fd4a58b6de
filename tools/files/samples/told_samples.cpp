#include "files/samples/told_samples.hpp"

#include <cstddef>
#include <fstream>
#include <string_view>

#include "files/input_file.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_writers.hpp"
#include "files/stream_path.hpp"

namespace geodisk::tools {
namespace {

/// Bytes that a head may have: headers name up to 64 classes and levels.
constexpr std::size_t kHead = std::size_t{1} << 16;

std::string head_of(const Path& path) {
    std::string head(kHead, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    return head;
}

} // namespace

bool begins_as_samples(const Path& path) {
    if (input_stream(path)) { // Which can be read just once.
        return false;
    }
    const std::string extension = lower_extension(path);
    const std::string text = head_of(path);
    const std::string_view head = text;
    const auto has = [&](std::string_view part) { return head.find(part) != head.npos; };
    if (extension == ".ply") {
        return head.starts_with("ply") && has("\nend_header") && has(" bary_u\n") &&
               !has("\nelement face ");
    }
    if (extension == ".obj") {
        return head.starts_with("# version: geodisk ");
    }
    if (extension == ".glb" || extension == ".gltf") {
        return has(R"("generator":"geodisk")") || has(R"("generator": "geodisk")");
    }
    if (extension == ".vtp") {
        return has(kVtpSamples);
    }
    return false;
}

bool holds_samples(const Path& path) {
    if (begins_as_samples(path)) {
        return true;
    }
    try {
        return !input_stream(path) && read_samples(path).has_faces;
    } catch (const UserError&) {
        return false;
    }
}

} // namespace geodisk::tools
