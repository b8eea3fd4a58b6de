// Lists of meshes, one per line with options of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

struct ManifestLine {
    std::uint32_t number; ///< In the file, from 1.
    std::vector<std::string> words;
};

/// The lines that have words. Throws UserError: `bad_input` for a file that cannot be read, `usage`
/// naming the line for a quote without end.
std::vector<ManifestLine> read_manifest(const Path& path);

/// "PATH: line NUMBER".
std::string line_text(const Path& path, std::uint32_t number);

} // namespace geodisk::tools
