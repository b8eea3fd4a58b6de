// The images that materials name, each read once.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "geometry/material_colours.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

class NamedImages {
  public:
    NamedImages(const FileScope& scope, std::vector<ImageFile>& images,
                std::vector<MeshWarning>& warnings)
        : scope_(scope), images_(images), warnings_(warnings) {}

    /// Name of the image in messages.
    struct Place {
        const Path& file;
        std::string line;   ///< "line 2: ", or "".
        std::string owner;  ///< "material 'a': ", or "".
        const char* advice; ///< What to do if the image is not there.
    };

    /// Gives the image `name`, or the tiles of its set, to a material. Throws UserError(bad_input).
    void take(const std::string& name, const Place& place, MaterialColour& material);

  private:
    std::uint32_t index_of(const std::string& name, const Place& place);

    const FileScope& scope_;
    std::vector<ImageFile>& images_;
    std::vector<MeshWarning>& warnings_;
    std::map<std::string, std::uint32_t> known_;
};

} // namespace geodisk::tools
