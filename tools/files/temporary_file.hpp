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

} // namespace geodisk::tools
