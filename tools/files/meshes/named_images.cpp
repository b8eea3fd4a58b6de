#include "files/meshes/named_images.hpp"

#include <optional>
#include <system_error>

#include "files/input_file.hpp"
#include "files/meshes/image_tiles.hpp"
#include "files/name_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

void NamedImages::take(const std::string& name, const Place& place, MaterialColour& material) {
    const auto set = tile_name(name);
    const auto tiles = set ? find_tiles(place.file, *set) : std::map<std::uint32_t, std::string>();
    material.has_tiles_by_name = set && set->is_pattern && !tiles.empty();
    if (tiles.size() < 2 && !material.has_tiles_by_name) {
        material.image = index_of(name, place);
        return;
    }
    for (const auto& [tile, file] : tiles) {
        material.tiles[tile] = index_of(file, place);
    }
    material.image = material.tiles.begin()->second;
    if (!set->is_pattern) {
        warnings_.push_back({"image_tiles",
                             1,
                             "",
                             place.owner + "its image " + in_quotes(name) + " and " +
                                 std::to_string(tiles.size() - 1) +
                                 " more are read as the tiles of one image (UDIM)",
                             {}});
    }
}

std::uint32_t NamedImages::index_of(const std::string& name, const Place& place) {
    const FoundFile found = scope_.find(place.file, name);
    const std::string image = place.line + place.owner + "its image ";
    if (!found.refusal.empty()) {
        fail_input(place.file, image + found.refusal);
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(found.file, ignored)) {
        fail_input(place.file, image + named_path(place.file, readable_name(name)).string() +
                                   " is not there; " + place.advice);
    }
    const auto next = static_cast<std::uint32_t>(images_.size());
    const auto [index, is_new] = known_.try_emplace(found.file.string(), next);
    if (is_new) {
        note_name(place.owner + "its image", found, warnings_);
        images_.push_back({place.file.string() + ": " + place.owner + found.file.string(),
                           read_regular_file(found.file)});
    }
    return index->second;
}

} // namespace geodisk::tools
