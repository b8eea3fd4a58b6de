// The files that a mesh file may name, by one rule for all formats.
#pragma once

#include <string>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the path that `name` means in the file `from`. Quotation marks around a name are left
/// out, and the '\' of Windows is a '/'.
Path named_path(const Path& from, std::string name);

/// Files of the folder of a mesh and of those below it, or any.
class FileScope {
  public:
    /// The mesh is a file or a stream; nothing is read for a stream, which has no folder.
    FileScope(Path mesh, bool allows_outside);

    /// Returns why the file that `from` calls `name` is not to be read, with the name; "" if it may
    /// be read, or is not there. `from` is the mesh, or a file that may be read.
    std::string refusal(const Path& from, const std::string& name) const;

  private:
    Path mesh_;
    bool allows_outside_;
};

} // namespace geodisk::tools
