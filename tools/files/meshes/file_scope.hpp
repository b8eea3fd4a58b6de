// The files that a mesh file may name, by one rule for all formats.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the path that `name` means in the file `from`. Quotation marks around a name are left
/// out, and the '\' of Windows is a '/'.
Path named_path(const Path& from, std::string name);

/// Returns the names in a folder, sorted; none if it cannot be read.
std::vector<std::string> names_in_folder(const Path& folder);

/// Returns the path of `name` in `folder`, where parts that are not there stand for the first one
/// that has the same letters in another case or composition.
Path path_like(const Path& folder, const std::string& name);

/// A file that another one names.
struct FoundFile {
    Path file;           ///< Empty if it is not there, or not to be read.
    std::string refusal; ///< Why it is not to be read, with the name; "" otherwise.
    std::string note;    ///< "'a.PNG' is read as a.png", if the name is another one.
};

/// Warns if `found` has another name. `what` names it, as "material 'a': its image".
void note_name(const std::string& what, const FoundFile& found, std::vector<MeshWarning>& warnings);

/// Files of the folder of a mesh and of those below it, or any.
class FileScope {
  public:
    /// The mesh is a file or a stream; nothing is read for a stream, which has no folder.
    FileScope(Path mesh, bool allows_outside);

    /// Returns why the file that `from` calls `name` is not to be read, with the name; "" if it may
    /// be read, or is not there. `from` is the mesh, or a file that may be read.
    std::string refusal(const Path& from, const std::string& name) const;

    /// Returns the file that `from` calls `name`: as it is; else with letters in another case;
    /// else, where folders of the name are not there, that of its last part beside `from`.
    FoundFile find(const Path& from, const std::string& name) const;

  private:
    /// Returns why a file of the folder, as names tell, is not to be read, if it is a link.
    std::string link_refusal(const Path& file, const std::string& name) const;

    Path mesh_;
    bool allows_outside_;
};

} // namespace geodisk::tools
