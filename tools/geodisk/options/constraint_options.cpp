#include "geodisk/options/constraint_options.hpp"

#include <algorithm>
#include <cctype>

#include "geodisk/options/class_options.hpp"
#include "geodisk/options/distance_options.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kAvoid = "--avoid";
constexpr const char* kClassAvoid = "--class-avoid";

AvoidOption parse_avoid(const std::string& name, const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
        fail_usage(name + ": " + in_quotes(text) +
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
        option.radius = parse_length(name, radius);
    } else if (option.kind == AvoidOption::Kind::file) {
        option.column = radius;
    } else {
        fail_usage(name + ": " + option.points + " takes a length, not " + in_quotes(radius) +
                   "; for a file of that name, write ./" + option.points);
    }
    return option;
}

/// Puts `place(name)` for the file of a value of --avoid.
void place_points(const std::string& name, std::string& text,
                  const std::function<std::string(const std::string&)>& place) {
    const std::size_t colon = text.rfind(':');
    if (colon != std::string::npos && parse_avoid(name, text).kind == AvoidOption::Kind::file) {
        text = place(text.substr(0, colon)) + text.substr(colon);
    }
}

} // namespace

std::vector<AvoidOption> ConstraintOptions::parsed_avoid() const {
    std::vector<AvoidOption> options;
    for (const std::string& text : avoid) {
        options.push_back(parse_avoid(kAvoid, text));
    }
    for (const std::string& text : class_avoid) {
        const OfClass own = parse_of_class(kClassAvoid, text);
        options.push_back(parse_avoid(kClassAvoid, own.text));
        options.back().only_class = own.number;
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

void ConstraintOptions::check_classes(std::size_t count) const {
    for (const std::string& text : class_avoid) {
        check_of_class(kClassAvoid, parse_of_class(kClassAvoid, text), count);
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
        place_points(kAvoid, text, place);
    }
    for (std::string& text : class_avoid) {
        OfClass own = parse_of_class(kClassAvoid, text);
        place_points(kClassAvoid, own.text, place);
        text = own.joined();
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
    for (const std::string& text : class_avoid) {
        entries.emplace_back("class_avoid", text);
    }
    return entries;
}

void add_avoid_option(Command command, ConstraintOptions& options, OptionUse use,
                      const std::string& group) {
    command
        .add_option(kAvoid, options.avoid, "POINTS:RADIUS",
                    help_for(use,
                             "Place no new sample within RADIUS of the points and lines of a\n",
                             "Check that new samples keep RADIUS from points and lines of a\n") +
                        "file, along the surface. RADIUS: a length, or the name of a\n"
                        "column of the file with one per point. POINTS may be border or\n"
                        "creases: edges of the mesh. May be given several times",
                    group)
        .takes_one_value();
    command
        .add_option(kClassAvoid, options.class_avoid, "CLASS:POINTS:RADIUS",
                    "The same for samples of one class of --classes", group)
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
