// Files under temporary names, which no process but the one that made them uses, and which the next
// one removes where that one was killed.
#pragma once

#include <cstdio>
#include <filesystem>

namespace geodisk::tools {

struct TemporaryFile {
    std::FILE* file = nullptr; ///< To write. Null if there is none, with errno set.
    std::filesystem::path path;
};

/// Makes one in the folder of `target`, to become that, and removes those for the same target whose
/// process is gone.
TemporaryFile make_temporary(const std::filesystem::path& target);

/// Gives the file `temporary` the further name `target` if nothing has it; where the file system
/// knows no such names, puts an empty file there. Returns 0, EEXIST or another errno value.
int claim_name(const std::filesystem::path& temporary, const std::filesystem::path& target);

/// Moves the file to `target`, in place of what is there. Returns 0 or an errno value.
int move_file(const std::filesystem::path& temporary, const std::filesystem::path& target);

} // namespace geodisk::tools
