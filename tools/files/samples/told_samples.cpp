#include "files/samples/told_samples.hpp"

#include <cstddef>
#include <string>
#include <string_view>

#include "files/input_file.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_writers.hpp"
#include "files/stream_path.hpp"

namespace geodisk::tools {
namespace {

/// Bytes of a head: headers name up to 64 classes and levels.
constexpr std::size_t kHead = std::size_t{1} << 16;

} // namespace

bool begins_as_samples(const Path& path) {
    const std::string extension = lower_extension(path);
    const std::string text = head_of(path, kHead);
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
