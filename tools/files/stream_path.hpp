// Paths of streams rather than files: "-", /dev/stdout, /dev/fd/N, pipes and devices.
#pragma once

#include <filesystem>
#include <optional>

#include "program/path.hpp"

namespace geodisk::tools {

/// A stream that a path names.
struct StreamPath {
    int descriptor = -1; ///< Number of the stream, which is open already; -1 for one to open.
};

/// Returns the stream that `path` names: "-" is the descriptor `standard`, and symbolic links are
/// followed. Returns nothing for regular files, folders, and names of nothing.
std::optional<StreamPath> find_stream(const Path& path, int standard);

/// Returns the stream to write to: "-" is standard output.
std::optional<StreamPath> output_stream(const Path& path);

/// Returns the stream to read from: "-" is standard input.
std::optional<StreamPath> input_stream(const Path& path);

/// Returns true for "-" and other names of standard output.
bool is_standard_output(const Path& path);

/// Follows symbolic links, also to what does not exist, up to the name of a descriptor. Returns
/// nothing for a circle of links.
std::optional<std::filesystem::path> followed(const Path& path);

} // namespace geodisk::tools
