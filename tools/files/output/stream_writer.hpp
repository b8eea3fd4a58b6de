// Writing to streams.
#pragma once

#include <string_view>

#include "files/stream_path.hpp"

namespace geodisk::tools {

/// Writes `bytes` to the stream, which is opened as `path` where it is not open yet, behind all
/// that this program has written to it. Returns 0 or an errno value.
int write_stream(const std::filesystem::path& path, const StreamPath& stream,
                 std::string_view bytes);

} // namespace geodisk::tools
