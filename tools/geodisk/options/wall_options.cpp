#include "geodisk/options/wall_options.hpp"

#include <string_view>
#include <utility>

#include "geometry/crease_edges.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kWalls = "--walls";
constexpr std::string_view kCreases = "creases", kEdges = "edges:";
constexpr double kTurned = 180;

CreaseWalls parse_creases(const std::string& text) {
    if (text.size() == kCreases.size()) {
        return {kCrease};
    }
    const auto degrees = parse_real(std::string_view(text).substr(kCreases.size() + 1));
    if (!degrees || !(*degrees >= 1 && *degrees <= kTurned)) {
        fail_usage(std::string(kWalls) + ": " + in_quotes(text) +
                   " has no angle of 1 to 180 degrees");
    }
    return {*degrees};
}

WallRule parse_wall(const std::string& text) {
    if (auto part = parse_part(kWalls, text)) {
        return *std::move(part);
    }
    if (text == kCreases || text.starts_with(std::string(kCreases) + ':')) {
        return parse_creases(text);
    }
    if (text.starts_with(kEdges) && text.size() > kEdges.size()) {
        return EdgeWalls{text.substr(kEdges.size())};
    }
    if (text.find_first_of("<>=") == std::string::npos && !text.starts_with("map:") &&
        !text.starts_with("file:")) {
        fail_usage(std::string(kWalls) + ": " + in_quotes(text) +
                   " is none of material:NAME, group:NAME, node:NAME, part:N, outside, "
                   "PROPERTY<VALUE, map:FILE, file:FILE, creases and edges:FILE");
    }
    return parse_mask(kWalls, text);
}

} // namespace

std::vector<WallRule> wall_rules(const std::vector<std::string>& walls) {
    std::vector<WallRule> rules;
    rules.reserve(walls.size());
    for (const std::string& text : walls) {
        rules.push_back(parse_wall(text));
    }
    return rules;
}

std::vector<MaskRule> mask_rules_of(const std::vector<WallRule>& walls) {
    std::vector<MaskRule> rules;
    for (const WallRule& wall : walls) {
        if (const auto* const rule = std::get_if<MaskRule>(&wall)) {
            rules.push_back(*rule);
        }
    }
    return rules;
}

void add_wall_files(const std::vector<std::string>& walls, std::vector<NamedFile>& read) {
    for (const WallRule& wall : wall_rules(walls)) {
        if (const auto* const edges = std::get_if<EdgeWalls>(&wall)) {
            read.push_back({"the walls", edges->file});
        } else if (const auto* const rule = std::get_if<MaskRule>(&wall)) {
            if (const auto file = file_of(*rule)) {
                read.push_back({"the walls", *file});
            }
        }
    }
}

void place_wall_files(std::vector<std::string>& walls,
                      const std::function<std::string(const std::string&)>& place) {
    for (std::string& text : walls) {
        const WallRule wall = parse_wall(text);
        if (const auto* const edges = std::get_if<EdgeWalls>(&wall)) {
            text = std::string(kEdges) + place(edges->file);
        } else if (std::holds_alternative<MaskRule>(wall)) {
            place_file(kWalls, text, place);
        }
    }
}

} // namespace geodisk::tools
