// ZIP archives, as numpy writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// A file of an archive.
struct ZipMember {
    std::string name;
    std::string content;
};

/// Returns the files of the archive `bytes`, read from `path`, in the order of its directory.
/// Throws UserError(bad_input) for an archive that is damaged, cut short, encrypted, of 4 GiB or
/// more, or compressed in another way than DEFLATE.
std::vector<ZipMember> read_zip(const Path& path, std::string_view bytes);

} // namespace geodisk::tools
