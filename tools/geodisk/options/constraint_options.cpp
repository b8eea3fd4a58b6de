#include "geodisk/options/constraint_options.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "geodisk/options/tolerance_option.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

AvoidOption parse_avoid(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
        fail_usage("--avoid: " + in_quotes(text) +
                   " is not POINTS:RADIUS, such as wells.csv:5, wells.csv:size or border:5");
    }
    AvoidOption option;
    option.points = text.substr(0, colon);
    option.kind = option.points == "border"    ? AvoidOption::Kind::border
                  : option.points == "creases" ? AvoidOption::Kind::creases
                                               : AvoidOption::Kind::file;
    const std::string radius = text.substr(colon + 1);
    const bool is_number = std::isdigit(static_cast<unsigned char>(radius.front())) != 0 ||
                           std::string("+-.").find(radius.front()) != std::string::npos;
    if (is_number) {
        option.radius = parse_length("--avoid", radius);
    } else if (option.kind == AvoidOption::Kind::file) {
        option.column = radius;
    } else {
        fail_usage("--avoid: " + option.points + " takes a length, not " + in_quotes(radius) +
                   "; for a file of that name, write ./" + option.points);
    }
    return option;
}

} // namespace

std::vector<AvoidOption> ConstraintOptions::parsed_avoid() const {
    std::vector<AvoidOption> options;
    for (const std::string& text : avoid) {
        options.push_back(parse_avoid(text));
    }
    return options;
}

bool ConstraintOptions::reads_points() const {
    return !existing.empty() || std::ranges::any_of(parsed_avoid(), [](const AvoidOption& option) {
        return option.kind == AvoidOption::Kind::file;
    });
}

void ConstraintOptions::check() const {
    check_tolerance(tolerance);
    parsed_avoid();
    if (!reads_points() && !tolerance.empty()) {
        fail_usage("--tolerance is for points that are read; give --existing or --avoid");
    }
}

void ConstraintOptions::add_files(std::vector<NamedFile>& read) const {
    if (!existing.empty()) {
        read.push_back({"the existing samples", existing});
    }
    for (const AvoidOption& option : parsed_avoid()) {
        if (option.kind == AvoidOption::Kind::file) {
            read.push_back({"the points to avoid", option.points});
        }
    }
}

void ConstraintOptions::place_files(const std::function<std::string(const std::string&)>& place) {
    if (!existing.empty()) {
        existing = place(existing);
    }
    for (std::string& text : avoid) {
        const std::size_t colon = text.rfind(':');
        if (colon != std::string::npos && parse_avoid(text).kind == AvoidOption::Kind::file) {
            text = place(text.substr(0, colon)) + text.substr(colon);
        }
    }
}

HeaderEntries ConstraintOptions::entries() const {
    HeaderEntries entries;
    if (!existing.empty()) {
        entries.emplace_back("existing", existing);
    }
    for (const std::string& text : avoid) {
        entries.emplace_back("avoid", text);
    }
    return entries;
}

void add_avoid_option(Command command, ConstraintOptions& options, OptionUse use,
                      const std::string& group) {
    command
        .add_option("--avoid", options.avoid, "POINTS:RADIUS",
                    help_for(use,
                             "Place no new sample within RADIUS of the points and lines of a\n",
                             "Check that new samples keep RADIUS from points and lines of a\n") +
                        "file, along the surface. RADIUS: a length, or the name of a\n"
                        "column of the file with one per point. POINTS may be border or\n"
                        "creases: edges of the mesh. May be given several times",
                    group)
        .takes_one_value();
}

void add_constraint_options(Command command, ConstraintOptions& options) {
    const char* const group = "Constraints";
    command.add_option("--existing", options.existing, "SAMPLES",
                       "Keep the samples of a file, and place new ones at the distance\n"
                       "from them. They come first, marked by the column existing, and\n"
                       "count towards --count. Samples of this mesh, or points of\n"
                       "another program",
                       group);
    add_avoid_option(command, options, OptionUse::sampling, group);
    add_tolerance_option(command, options.tolerance, group);
}

} // namespace geodisk::tools
