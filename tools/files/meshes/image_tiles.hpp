// Images that are one for each unit square of texture coordinates (UDIM).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "files/meshes/file_scope.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Parts of the name of an image before and after the number of its tile.
struct TileName {
    std::string before, after;
    bool is_pattern = false; ///< The name has a placeholder; else it is that of tile 1001.
    bool has_places = false; ///< Tiles are called "u1_v1", not by numbers.
};

/// Returns the parts of a name with "<UDIM>" or "<UVTILE>", in any case, or with 1001 set apart by
/// other signs than letters and digits.
std::optional<TileName> tile_name(const std::string& name);

/// Returns the names that `from` would call the tiles by that are in the folder, by number from
/// 1001. They may be in another case.
std::map<std::uint32_t, std::string> find_tiles(const Path& from, const TileName& name);

} // namespace geodisk::tools
