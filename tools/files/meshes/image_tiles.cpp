#include "files/meshes/image_tiles.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "files/input_file.hpp"
#include "files/name_text.hpp"
#include "geometry/material_colours.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// Returns the number of a tile that the name calls `text`.
std::optional<std::uint32_t> tile_number(std::string_view text, bool has_places) {
    if (!has_places) {
        const auto number = parse_integer<std::uint32_t>(text);
        const bool is_tile = number && text.size() == 4 && *number >= kFirstTile;
        return is_tile ? number : std::nullopt;
    }
    const std::size_t bar = text.find("_v");
    if (!text.starts_with('u') || bar == std::string_view::npos) {
        return std::nullopt;
    }
    const auto u = parse_integer<std::uint32_t>(text.substr(1, bar - 1));
    const auto v = parse_integer<std::uint32_t>(text.substr(bar + 2));
    const bool is_tile = u && v && *u >= 1 && *u <= kTilesPerRow && *v >= 1 && *v <= 100;
    return is_tile ? std::optional(kFirstTile + *u - 1 + kTilesPerRow * (*v - 1)) : std::nullopt;
}

} // namespace

std::optional<TileName> tile_name(const std::string& name) {
    constexpr std::array<std::string_view, 3> kMarks{"<udim>", "<uvtile>", "1001"};
    const std::string lower = lower_case(name);
    for (const std::string_view mark : kMarks) {
        const std::size_t at = lower.rfind(mark);
        const std::size_t end = at + mark.size();
        if (at == std::string::npos || name.find_first_of("/\\", at) != std::string::npos) {
            continue;
        }
        const bool is_pattern = mark[0] == '<';
        const bool is_apart =
            at > 0 && !is_word(name[at - 1]) && end < name.size() && !is_word(name[end]);
        if (is_pattern || is_apart) {
            return TileName{name.substr(0, at), name.substr(end), is_pattern, mark == kMarks[1]};
        }
    }
    return std::nullopt;
}

std::map<std::uint32_t, std::string> find_tiles(const Path& from, const TileName& name) {
    const std::size_t slash = name.before.find_last_of("/\\");
    const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
    const std::string folder = name.before.substr(0, begin);
    const std::string before = folded_name(name.before.substr(begin)),
                      after = folded_name(name.after);
    std::map<std::uint32_t, std::string> tiles;
    for (const std::string& file : names_in_folder(path_like(from.parent_path(), folder))) {
        const std::string folded = folded_name(file);
        if (folded.size() < before.size() + after.size() || !folded.starts_with(before) ||
            !folded.ends_with(after)) {
            continue;
        }
        const std::string_view middle = std::string_view(folded).substr(
            before.size(), folded.size() - before.size() - after.size());
        if (const auto number = tile_number(middle, name.has_places)) {
            tiles.try_emplace(*number, folder + file);
        }
    }
    return tiles;
}

} // namespace geodisk::tools
