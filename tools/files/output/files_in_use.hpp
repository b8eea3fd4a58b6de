// All files that a command reads and writes, so that none is written that is read or written
// otherwise.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// A file of the command line, and what it is to the user: "the mesh".
struct NamedFile {
    std::string what, path;
    std::string format = {}; ///< Format of a mesh; "" for that of its extension.
};

class FilesInUse {
  public:
    /// Notes a file that is read. An empty path and built-in meshes are none. Throws
    /// UserError(usage) where standard input would be read twice.
    void add_read(const NamedFile& file);

    /// Notes a file that is written; an empty path is none. Throws UserError(usage) if the command
    /// reads or writes that file otherwise. Files that a mesh names, such as textures, are read.
    void add_written(const NamedFile& file);

    /// Does the same for a file that lines are added to.
    void add_appended(const NamedFile& file);

  private:
    void add_named_files();

    std::map<std::string, NamedFile> read_, written_; ///< By identity.
    std::vector<NamedFile> unopened_; ///< Read, and not looked at for names in them.
};

} // namespace geodisk::tools
