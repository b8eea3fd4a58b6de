#include "files/meshes/meshopt.hpp"

#include <meshoptimizer.h>

namespace geodisk::tools {
namespace {

constexpr std::uint64_t kMaxBytesPerElement = 256;
constexpr std::uint64_t kMaxShrinking = 4096; ///< Far more than any compressed file reaches.

/// False for a filter that is unknown or not made for such elements.
bool unfilter(std::string& bytes, const MeshoptStream& stream) {
    if (stream.filter.empty() || stream.filter == "NONE") {
        return true;
    }
    if (stream.filter == "OCTAHEDRAL" && (stream.stride == 4 || stream.stride == 8)) {
        meshopt_decodeFilterOct(bytes.data(), stream.count, stream.stride);
        return true;
    }
    if (stream.filter == "QUATERNION" && stream.stride == 8) {
        meshopt_decodeFilterQuat(bytes.data(), stream.count, stream.stride);
        return true;
    }
    if (stream.filter == "EXPONENTIAL" && stream.stride % 4 == 0) {
        meshopt_decodeFilterExp(bytes.data(), stream.count, stream.stride);
        return true;
    }
    return false;
}

bool decode(std::string& bytes, const MeshoptStream& stream) {
    const auto* const source = reinterpret_cast<const unsigned char*>(stream.bytes.data());
    const std::size_t size = stream.bytes.size();
    if (stream.mode == "ATTRIBUTES") {
        return stream.stride % 4 == 0 && stream.stride <= kMaxBytesPerElement &&
               meshopt_decodeVertexBuffer(bytes.data(), stream.count, stream.stride, source,
                                          size) == 0 &&
               unfilter(bytes, stream);
    }
    if (stream.stride != 2 && stream.stride != 4) {
        return false;
    }
    if (stream.mode == "TRIANGLES") {
        return stream.count % 3 == 0 && meshopt_decodeIndexBuffer(bytes.data(), stream.count,
                                                                  stream.stride, source, size) == 0;
    }
    return stream.mode == "INDICES" &&
           meshopt_decodeIndexSequence(bytes.data(), stream.count, stream.stride, source, size) ==
               0;
}

} // namespace

std::optional<std::string> meshopt_decoded(const MeshoptStream& stream) {
    if (stream.stride == 0 ||
        stream.count > (stream.bytes.size() + 1) * kMaxShrinking / stream.stride) {
        return std::nullopt;
    }
    std::string bytes(stream.count * stream.stride, '\0');
    return decode(bytes, stream) ? std::optional(std::move(bytes)) : std::nullopt;
}

std::string meshopt_failure() {
    return "and cannot be decoded";
}

} // namespace geodisk::tools
