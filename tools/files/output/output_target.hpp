// Target of an output file, and the file that it replaces.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>

#include "files/stream_path.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Whose a file is and who may use it. Of no meaning on Windows.
struct FileRights {
    unsigned mode = 0, owner = 0, group = 0;
};

struct OutputTarget {
    std::filesystem::path path; ///< With symbolic links followed, also where they lead to nothing.
    std::optional<FileRights> replaced; ///< Rights of the file that is there.
    std::optional<StreamPath> stream;   ///< Set for what is written to, not replaced.
};

/// Throws UserError(bad_output) for what cannot be written, and what should not be replaced:
/// folders, files that are write-protected, and those that have further names (hard links), which
/// would keep the old content.
OutputTarget output_target(const Path& path);

/// Gives an open file the rights of the one that it is to replace. 0, or an errno value if it is
/// somebody else's and cannot become so.
int take_rights(std::FILE* file, const FileRights& rights);

/// Throws UserError(bad_output) with "PATH: cannot write: REASON"; "-" is called standard output.
[[noreturn]] void fail_to_write(const Path& path, const std::string& reason);

} // namespace geodisk::tools
