#include "geodisk/options/density_options.hpp"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include <geodisk/radius_field.hpp>

#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Kind = DensitySource::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 3> kPrefixes{
    {{"attribute:", Kind::attribute}, {"file:", Kind::file}, {"map:", Kind::map}}};

/// Returns what `option`, one of given(), says, as --density and --radius-factor take it.
std::string source_text(const std::string& option, const std::string& value) {
    constexpr std::string_view kBefore = "--density-"; // Then a kind.
    if (!option.starts_with(kBefore)) {
        return value;
    }
    const std::string kind = option.substr(kBefore.size());
    return value.empty() ? kind : kind + ':' + value;
}

} // namespace

DensitySource parse_source(const std::string& option, const std::string& text) {
    DensitySource source;
    source.option = option;
    source.name = text;
    if (text == "curvature") {
        source.kind = Kind::curvature;
        source.name.clear();
        return source;
    }
    for (const auto& [prefix, kind] : kPrefixes) {
        if (text.starts_with(prefix)) {
            source.kind = kind;
            source.name = text.substr(prefix.size());
            if (source.name.empty()) {
                fail_usage(option + ": " + in_quotes(text) + " names nothing");
            }
            return source;
        }
    }
    std::error_code ignored;
    if (text.find('.') != std::string::npos && std::filesystem::is_regular_file(text, ignored)) {
        fail_usage(option + ": " + in_quotes(text) + " is a file; give file:" + text +
                   " for values, or map:" + text + " for an image");
    }
    return source;
}

std::string DensitySource::text() const {
    for (const auto& [prefix, of] : kPrefixes) {
        if (kind == of) {
            return std::string(prefix) + name;
        }
    }
    return "curvature";
}

HeaderEntries DensityOptions::given() const {
    HeaderEntries result;
    for (const auto& [name, value] : {std::pair{"--density", density},
                                      {"--radius-factor", radius_factor},
                                      {"--density-attribute", attribute},
                                      {"--density-file", file},
                                      {"--density-map", map}}) {
        if (!value.empty()) {
            result.emplace_back(name, value);
        }
    }
    if (curvature) {
        result.emplace_back("--density-curvature", "");
    }
    return result;
}

std::optional<DensitySource> DensityOptions::source() const {
    const HeaderEntries sources = given();
    if (sources.size() > 1) {
        std::string names;
        for (const auto& [name, value] : sources) {
            names += (names.empty() ? "" : " and ") + name;
        }
        fail_usage(names + " contradict each other; give just one of them");
    }
    if (!floor.empty() && !factor_floor.empty()) {
        fail_usage("--density-floor and --radius-factor-floor are the same; give just one of them");
    }
    const char* const floor_name = floor.empty() ? "--radius-factor-floor" : "--density-floor";
    const std::string& least = floor.empty() ? factor_floor : floor;
    if (sources.empty()) {
        if (!least.empty()) {
            fail_usage(std::string(floor_name) + " raises radius factors; give --radius-factor");
        }
        return std::nullopt;
    }
    const auto& [name, value] = sources.front();
    DensitySource source = parse_source(name, source_text(name, value));
    source.is_density = is_density();
    if (!least.empty()) {
        if (source.is_density) {
            fail_usage(std::string(floor_name) +
                       " raises radius factors; --density takes 0 and any range as they are");
        }
        source.floor = parse_ratio(floor_name, least, RadiusField::kMinFactor, 1);
    } else if (source.kind == Kind::curvature) {
        source.floor = kCurvatureFloor;
    }
    return source;
}

std::optional<MeshWarning> DensityOptions::warning() const {
    const auto of = source();
    if (!of || of->option == "--density" || of->option == "--radius-factor") {
        return std::nullopt;
    }
    if (of->kind == Kind::curvature) {
        return MeshWarning{"old_option", 1, "",
                           "--density-curvature is now --density curvature, or with the distance "
                           "of the largest radius --radius-factor curvature",
                           ""};
    }
    return MeshWarning{"old_option", 1, "",
                       of->option + " gives factors of the radius and is now --radius-factor " +
                           of->text() + "; for a density, where more means more samples, give " +
                           "--density " + of->text(),
                       ""};
}

void DensityOptions::add_files(std::vector<NamedFile>& read, const std::string& what) const {
    const auto of = source();
    if (of && of->reads_file()) {
        read.push_back({what, of->name});
    }
}

void DensityOptions::place_files(const std::function<std::string(const std::string&)>& place) {
    const auto of = source();
    if (!of || !of->reads_file()) {
        return;
    }
    DensitySource placed = *of;
    placed.name = place(of->name);
    if (!density.empty()) {
        density = placed.text();
    } else if (!radius_factor.empty()) {
        radius_factor = placed.text();
    } else {
        (file.empty() ? map : file) = placed.name;
    }
}

HeaderEntries DensityOptions::added_to(HeaderEntries entries) const {
    if (const auto of = source()) {
        entries.emplace_back(of->is_density ? "density" : "radius_factor", of->text());
        if (const std::string& least = floor.empty() ? factor_floor : floor; !least.empty()) {
            entries.emplace_back("radius_factor_floor", least);
        }
    }
    return entries;
}

void add_density_options(Command command, DensityOptions& options, OptionUse use) {
    const char* const density = "Density, give one";
    command.add_option("--density", options.density, "SOURCE",
                       help_for(use, "Make samples per area proportional to a density, in any\n",
                                "Radii are those of a density of samples per area, in any\n") +
                           "unit; 0 for none. SOURCE: attribute:NAME or NAME (attribute\n"
                           "of the mesh file, as red), file:FILE (one value per vertex\n"
                           "and line), map:FILE (grey of an image at the texture\n"
                           "coordinates) or curvature. The distance applies where the\n"
                           "density is largest",
                       density);
    command.add_option("--radius-factor", options.radius_factor, "SOURCE",
                       help_for(use,
                                "Multiply the radius by a factor g, 0 < g <= 1; smaller\n"
                                "factors give more samples. ",
                                "Radii are the largest one times a factor g, 0 < g <= 1.\n") +
                           "SOURCE as for --density. The\n"
                           "distance applies where g is 1. (Aliases: the options\n"
                           "--density-attribute, -file, -map and -curvature)",
                       density);
    command.add_option("--radius-factor-floor", options.factor_floor, "G",
                       "Raise smaller factors to G (default for curvature 0.1)", density);
    const char* const hidden = "";
    command.add_option("--density-attribute", options.attribute, "NAME", "Factors", hidden);
    command.add_option("--density-file", options.file, "FILE", "Factors", hidden);
    command.add_option("--density-map", options.map, "FILE", "Factors", hidden);
    command.add_flag("--density-curvature", options.curvature, "Factors", hidden);
    command.add_option("--density-floor", options.floor, "G", "Minimum factor", hidden);
}

} // namespace geodisk::tools
