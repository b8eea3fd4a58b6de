#include "files/archives/inflate.hpp"

#include <limits>

#include <zlib.h>

namespace geodisk::tools {

std::optional<std::string> inflated(const Path& /*path*/, std::string_view compressed,
                                    std::size_t size, Wrapping wrapping) {
    constexpr std::size_t kMaxRatio = 1032; // Of DEFLATE; more is damage, which is not to allocate.
    if (compressed.size() > std::numeric_limits<uInt>::max() ||
        size > std::numeric_limits<uInt>::max() || size / kMaxRatio > compressed.size()) {
        return std::nullopt;
    }
    std::string bytes(size, '\0');
    std::string input(compressed); // Zlib takes no constant bytes.
    z_stream stream{};
    constexpr int kRaw = -15, kEither = 15 + 32; // Bits of the window, and how it is wrapped.
    if (inflateInit2(&stream, wrapping == Wrapping::none ? kRaw : kEither) != Z_OK) {
        return std::nullopt;
    }
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(input.size());
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = static_cast<uInt>(size);
    const int status = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    return status == Z_STREAM_END && stream.avail_out == 0 ? std::optional(std::move(bytes))
                                                           : std::nullopt;
}

} // namespace geodisk::tools
