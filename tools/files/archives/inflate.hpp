// Decompression of what ZIP archives and mesh files hold.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "program/path.hpp"

namespace geodisk::tools {

/// Wrapping of compressed bytes: none, or the header and checksum of zlib or gzip.
enum class Wrapping { none, zlib_or_gzip };

/// Returns the `size` bytes that `compressed` holds in the format DEFLATE; nothing if it is damaged
/// or holds another number of bytes. `path` is the file that an error names: throws
/// UserError(bad_input) where geodisk was built without zlib.
std::optional<std::string> inflated(const Path& path, std::string_view compressed, std::size_t size,
                                    Wrapping wrapping = Wrapping::none);

} // namespace geodisk::tools
