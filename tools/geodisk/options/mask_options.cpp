#include "geodisk/options/mask_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "files/meshes/value_fields.hpp"
#include <geodisk/outside_faces.hpp>

#include "files/samples/sample_columns.hpp"
#include "geodisk/options/class_options.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/path.hpp"

namespace geodisk::tools {
namespace {

using RuleKind = OnlyRule::Kind;
using Comparison = MaskRule::Comparison;

constexpr std::array<std::pair<std::string_view, RuleKind>, 4> kKinds{
    {{"material:", RuleKind::material},
     {"group:", RuleKind::group},
     {"node:", RuleKind::node},
     {"part:", RuleKind::part}}};
// Longer ones first.
constexpr std::array<std::pair<std::string_view, Comparison>, 6> kComparisons{
    {{"<=", Comparison::at_most},
     {">=", Comparison::at_least},
     {"!=", Comparison::unequal},
     {"<", Comparison::less},
     {">", Comparison::greater},
     {"=", Comparison::equal}}};
constexpr std::string_view kOutside = "outside";
constexpr const char* kMask = "--mask";
constexpr const char* kClassMask = "--class-mask";
constexpr const char* kClassDensity = "--class-density";
constexpr std::pair<const char*, std::vector<std::string> MaskOptions::*> kLists[] = {
    {"--only", &MaskOptions::only},
    {kMask, &MaskOptions::masks},
    {kClassMask, &MaskOptions::class_masks},
    {kClassDensity, &MaskOptions::class_densities}};
constexpr std::string_view kMap = "map:";
/// Grey of an image from which on it counts as white.
constexpr double kWhite = 0.5;

/// Returns the key of an option in headers.
std::string key_of(const std::string& option) {
    std::string key = option.substr(2);
    std::ranges::replace(key, '-', '_');
    return key;
}

OnlyRule parse_only(const std::string& text) {
    if (auto rule = parse_part("--only", text)) {
        return *std::move(rule);
    }
    fail_usage("--only: " + in_quotes(text) +
               " is none of material:NAME, group:NAME, node:NAME, part:N and outside");
}

bool is_file(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::exists(Path(name), ignored);
}

/// The comparison that ends `text`, a value of `option`, whose first sign is at `at`.
MaskRule parse_comparison(const std::string& option, const std::string& text, std::size_t at) {
    for (const auto& [sign, comparison] : kComparisons) {
        if (std::string_view(text).substr(at).starts_with(sign)) {
            const std::string given = text.substr(at + sign.size());
            const auto value = parse_real(given);
            const bool may_be_name =
                value_file(text) && !given.empty() &&
                (comparison == Comparison::equal || comparison == Comparison::unequal);
            const bool is_number = value && !std::isnan(*value);
            if (at == 0 || (!is_number && !may_be_name)) {
                break;
            }
            return {false, text.substr(0, at), comparison, is_number ? *value : std::nan(""),
                    may_be_name ? given : ""};
        }
    }
    fail_usage(option + ": " + in_quotes(text) +
               " is not PROPERTY<VALUE, with one of < <= > >= = != and a number");
}

/// Reads an image behind "map:" or a file of values behind "file:", with a comparison or without.
MaskRule parse_file(const std::string& option, const std::string& text, std::string_view prefix) {
    const bool is_map = prefix == kMap;
    const std::string name = text.substr(prefix.size());
    if (name.empty()) {
        fail_usage(option + ": " + in_quotes(text) + " names nothing");
    }
    std::size_t at = text.find_last_of("<>=");
    if (at == std::string::npos || is_file(name)) {
        MaskRule white{is_map, is_map ? name : text, Comparison::at_least, kWhite};
        white.has_comparison = false;
        return white;
    }
    const bool has_two =
        text[at] == '=' && std::string_view("<>!").find(text[at - 1]) != std::string_view::npos;
    at -= has_two ? 1 : 0;
    MaskRule rule = parse_comparison(option, text, at);
    rule.is_map = is_map;
    rule.name.erase(0, is_map ? prefix.size() : 0);
    return rule;
}

} // namespace

std::optional<OnlyRule> parse_part(const std::string& option, const std::string& text) {
    if (text == kOutside) {
        return OnlyRule{RuleKind::outside, "", kOutsideShare, text, option};
    }
    if (text.starts_with(std::string(kOutside) + ':')) {
        const auto share = parse_real(std::string_view(text).substr(kOutside.size() + 1));
        if (!share || !(*share >= 0 && *share <= 1)) {
            fail_usage(option + ": " + in_quotes(text) +
                       " has no share of rays from 0 to 1, as outside:0.1");
        }
        return OnlyRule{RuleKind::outside, "", *share, text, option};
    }
    for (const auto& [prefix, kind] : kKinds) {
        if (text.starts_with(prefix) && text.size() > prefix.size()) {
            OnlyRule rule{kind, text.substr(prefix.size()), 0, text, option};
            if (kind == RuleKind::part && !parse_integer<std::uint32_t>(rule.name)) {
                fail_usage(option + ": " + in_quotes(text) +
                           " is not the number of a part; --columns part tells the numbers");
            }
            return rule;
        }
    }
    return std::nullopt;
}

MaskRule parse_mask(const std::string& option, const std::string& text) {
    MaskRule rule;
    if (text.starts_with(kMap)) {
        rule = parse_file(option, text, kMap);
    } else if (text.starts_with(kValueFile)) {
        rule = parse_file(option, text, kValueFile);
    } else {
        const std::size_t at = text.find_first_of("<>=!");
        if (at == std::string::npos && is_file(text)) {
            fail_usage(option + ": " + in_quotes(text) + " is a file; give map:" + text +
                       " for an image, file:" + text +
                       " for values, or a property and a comparison");
        }
        rule = parse_comparison(option, text, std::min(at, text.size()));
    }
    rule.option = option;
    return rule;
}

std::optional<std::string> file_of(const MaskRule& rule) {
    return rule.is_map ? std::optional(rule.name) : value_file(rule.name);
}

void place_file(const std::string& option, std::string& text,
                const std::function<std::string(const std::string&)>& place) {
    const MaskRule rule = parse_mask(option, text);
    if (const auto file = file_of(rule)) {
        const std::string prefix(rule.is_map ? kMap : kValueFile);
        const std::string comparison = text.substr(prefix.size() + file->size());
        text = prefix + place(*file) + comparison;
    }
}

bool MaskRule::holds(double of) const {
    switch (comparison) {
    case Comparison::less:
        return of < value;
    case Comparison::at_most:
        return of <= value;
    case Comparison::equal:
        return of == value;
    case Comparison::unequal:
        return of < value || of > value;
    case Comparison::at_least:
        return of >= value;
    case Comparison::greater:
        break;
    }
    return of > value;
}

std::optional<std::size_t> MaskRule::axis() const {
    if (is_map) {
        return std::nullopt;
    }
    if (const std::size_t at = std::string_view("xyz").find(name); name.size() == 1 && at < 3) {
        return at;
    }
    const auto found = std::ranges::find(kNumberedColumnNames, name);
    return found == kNumberedColumnNames.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - kNumberedColumnNames.begin()));
}

std::vector<OnlyRule> MaskOptions::only_rules() const {
    std::vector<OnlyRule> rules;
    for (const std::string& text : only) {
        rules.push_back(parse_only(text));
    }
    return rules;
}

std::vector<MaskRule> MaskOptions::mask_rules() const {
    std::vector<MaskRule> rules;
    for (const std::string& text : masks) {
        rules.push_back(parse_mask(kMask, text));
    }
    return rules;
}

std::vector<ClassPlace> MaskOptions::class_places() const {
    std::map<std::uint8_t, ClassPlace> places;
    for (const std::string& text : class_masks) {
        const OfClass own = parse_of_class(kClassMask, text);
        ClassPlace& place = places[own.number];
        place.texts.push_back(text);
        place.rules.push_back(parse_mask(kClassMask, own.text));
    }
    for (const std::string& text : class_densities) {
        const OfClass own = parse_of_class(kClassDensity, text);
        ClassPlace& place = places[own.number];
        if (place.density) {
            fail_usage(std::string(kClassDensity) + " is given twice for class " +
                       std::to_string(own.number));
        }
        place.density = parse_source(kClassDensity, own.text);
        place.density->is_density = true;
    }
    std::vector<ClassPlace> result;
    for (auto& [number, place] : places) {
        place.number = number;
        result.push_back(std::move(place));
    }
    return result;
}

void MaskOptions::check(std::size_t classes) const {
    only_rules();
    mask_rules();
    class_places();
    for (const auto& [option, values] :
         {std::pair{kClassMask, &class_masks}, {kClassDensity, &class_densities}}) {
        for (const std::string& text : *values) {
            check_of_class(option, parse_of_class(option, text), classes);
        }
    }
}

void MaskOptions::add_files(std::vector<NamedFile>& read) const {
    const auto add_rules = [&](const std::vector<MaskRule>& rules) {
        for (const MaskRule& rule : rules) {
            if (const auto file = file_of(rule)) {
                read.push_back({"the mask", *file});
            }
        }
    };
    add_rules(mask_rules());
    for (const ClassPlace& place : class_places()) {
        add_rules(place.rules);
        if (place.density && place.density->reads_file()) {
            read.push_back({"the density", place.density->name});
        }
    }
}

void MaskOptions::place_files(const std::function<std::string(const std::string&)>& place) {
    for (std::string& text : masks) {
        place_file(kMask, text, place);
    }
    for (std::string& text : class_masks) {
        OfClass own = parse_of_class(kClassMask, text);
        place_file(kClassMask, own.text, place);
        text = own.joined();
    }
    for (std::string& text : class_densities) {
        OfClass own = parse_of_class(kClassDensity, text);
        DensitySource source = parse_source(kClassDensity, own.text);
        if (source.reads_file()) {
            source.name = place(source.name);
            own.text = source.text();
            text = own.joined();
        }
    }
}

HeaderEntries MaskOptions::entries() const {
    HeaderEntries entries;
    for (const auto& [option, values] : kLists) {
        for (const std::string& text : this->*values) {
            entries.emplace_back(key_of(option), text);
        }
    }
    return entries;
}

std::string MaskOptions::names() const {
    std::string names;
    for (const auto& [option, values] : kLists) {
        if (!(this->*values).empty()) {
            names += (names.empty() ? "" : " and ") + std::string(option);
        }
    }
    return names;
}

HeaderEntries with_entries(HeaderEntries entries, const MaskOptions& options) {
    const HeaderEntries own = options.entries();
    entries.insert(entries.end(), own.begin(), own.end());
    return entries;
}

void add_mask_options(Command command, MaskOptions& options, OptionUse use) {
    const char* const group =
        use == OptionUse::choosing ? "Part of the surface" : "Where samples may lie";
    command
        .add_option("--only", options.only, "PART",
                    help_for(use, "Sample only", "Samples lie on", "Take only") +
                        " material:NAME, group:NAME (OBJ group or object),\n"
                        "node:NAME (with the nodes below it), part:N (no path joins it\n"
                        "to others) or outside (what can be seen from there; outside:S\n"
                        "if a share S of rays sees it). A number may replace NAME.\n"
                        "Repeat to select more faces. Paths cross what is left out",
                    group)
        .takes_one_value();
    command
        .add_option(kMask, options.masks, "RULE",
                    help_for(use, "Sample only", "Samples lie on", "Take only") +
                        " faces where PROPERTY<VALUE (or <= > >= = !=) holds:\n"
                        "x, y, z (x0 to x7 in R^n) or an attribute, as red, at all\n"
                        "corners, or of the face. map:FILE: what is white in an image, or\n"
                        "compared as a property from 0 to 1. file:FILE: values of\n"
                        "vertices, as file:lh.curv<0 or file:lh.aparc.annot=insula; a\n"
                        "list of vertices needs no comparison. Repeat to add rules",
                    group)
        .takes_one_value();
    if (use == OptionUse::choosing) {
        return;
    }
    command
        .add_option(kClassMask, options.class_masks, "CLASS:RULE",
                    "The same for samples of one class of --classes, numbered from 0", group)
        .takes_one_value();
    command
        .add_option(kClassDensity, options.class_densities, "CLASS:SOURCE",
                    help_for(use,
                             "Give samples of one class a density: where it is half of the\n"
                             "largest, the class has half of the samples that fit. SOURCE as\n"
                             "for --density",
                             "Check that samples of one class lie where its density is not 0"),
                    group)
        .takes_one_value();
}

} // namespace geodisk::tools
