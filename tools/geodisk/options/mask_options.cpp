#include "geodisk/options/mask_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "files/samples/sample_columns.hpp"
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
constexpr std::string_view kMap = "map:";
/// Grey of an image from which on it counts as white.
constexpr double kWhite = 0.5;

OnlyRule parse_only(const std::string& text) {
    for (const auto& [prefix, kind] : kKinds) {
        if (text.starts_with(prefix) && text.size() > prefix.size()) {
            OnlyRule rule{kind, text.substr(prefix.size()), text};
            if (kind == RuleKind::part && !parse_integer<std::uint32_t>(rule.name)) {
                fail_usage("--only: " + in_quotes(text) +
                           " is not the number of a part; --columns part tells the numbers");
            }
            return rule;
        }
    }
    fail_usage("--only: " + in_quotes(text) +
               " is none of material:NAME, group:NAME, node:NAME and part:N");
}

bool is_file(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::exists(Path(name), ignored);
}

/// The comparison that ends `text`, whose first sign is at `at`.
MaskRule parse_comparison(const std::string& text, std::size_t at) {
    for (const auto& [sign, comparison] : kComparisons) {
        if (std::string_view(text).substr(at).starts_with(sign)) {
            const auto value = parse_real(std::string_view(text).substr(at + sign.size()));
            if (at == 0 || !value || std::isnan(*value)) {
                break;
            }
            return {false, text.substr(0, at), comparison, *value};
        }
    }
    fail_usage("--mask: " + in_quotes(text) +
               " is not PROPERTY<VALUE, with one of < <= > >= = != and a number");
}

MaskRule parse_map(const std::string& text) {
    const std::string name = text.substr(kMap.size());
    if (name.empty()) {
        fail_usage("--mask: " + in_quotes(text) + " names nothing");
    }
    std::size_t at = text.find_last_of("<>=");
    if (at == std::string::npos || is_file(name)) {
        return {true, name, Comparison::at_least, kWhite};
    }
    const bool has_two =
        text[at] == '=' && std::string_view("<>!").find(text[at - 1]) != std::string_view::npos;
    at -= has_two ? 1 : 0;
    MaskRule rule = parse_comparison(text, at);
    rule.is_map = true;
    rule.name.erase(0, kMap.size());
    return rule;
}

MaskRule parse_mask(const std::string& text) {
    if (text.starts_with(kMap)) {
        return parse_map(text);
    }
    const std::size_t at = text.find_first_of("<>=!");
    if (at == std::string::npos && is_file(text)) {
        fail_usage("--mask: " + in_quotes(text) + " is a file; give map:" + text +
                   " for an image, or a property and a comparison");
    }
    return parse_comparison(text, std::min(at, text.size()));
}

} // namespace

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
        rules.push_back(parse_mask(text));
    }
    return rules;
}

void MaskOptions::add_files(std::vector<NamedFile>& read) const {
    for (const MaskRule& rule : mask_rules()) {
        if (rule.is_map) {
            read.push_back({"the mask", rule.name});
        }
    }
}

void MaskOptions::place_files(const std::function<std::string(const std::string&)>& place) {
    for (std::string& text : masks) {
        if (const MaskRule rule = parse_mask(text); rule.is_map) {
            const std::string comparison = text.substr(kMap.size() + rule.name.size());
            text = std::string(kMap) + place(rule.name) + comparison;
        }
    }
}

HeaderEntries MaskOptions::entries() const {
    HeaderEntries entries;
    for (const std::string& text : only) {
        entries.emplace_back("only", text);
    }
    for (const std::string& text : masks) {
        entries.emplace_back("mask", text);
    }
    return entries;
}

std::string MaskOptions::names() const {
    return only.empty() ? "--mask" : masks.empty() ? "--only" : "--only and --mask";
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
                        "node:NAME (with the nodes below it) or part:N (no path joins\n"
                        "it to others). A number may replace NAME. Repeat to select\n"
                        "more faces. Paths cross faces that are left out",
                    group)
        .takes_one_value();
    command
        .add_option("--mask", options.masks, "RULE",
                    help_for(use, "Sample only", "Samples lie on", "Take only") +
                        " faces where PROPERTY<VALUE (or <= > >= = !=) holds:\n"
                        "x, y, z (x0 to x7 in R^n) or an attribute, as red, at all\n"
                        "corners, or of the face. map:FILE: what is white in an image, or\n"
                        "compared as a property from 0 to 1. Repeat to add rules",
                    group)
        .takes_one_value();
}

} // namespace geodisk::tools
