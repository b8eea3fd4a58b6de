#include "geodisk/options/class_options.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <geodisk/params.hpp>

#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Rows = std::vector<std::vector<double>>;
/// Throws UserError.
using Fail = std::function<void(const std::string& message)>;

constexpr std::string_view kDividers = ", \t";

std::vector<double> numbers_in(std::string_view line, const Fail& fail) {
    std::vector<double> numbers;
    while (line.find_first_not_of(kDividers) != std::string_view::npos) {
        line.remove_prefix(line.find_first_not_of(kDividers));
        const std::string_view word = line.substr(0, line.find_first_of(kDividers));
        const std::optional<double> number = parse_real(word);
        if (!number) {
            fail(in_quotes(std::string(word)) + " is no number");
        }
        numbers.push_back(*number);
        line.remove_prefix(word.size());
    }
    return numbers;
}

std::string entry_text(std::size_t a, std::size_t b) {
    return "of classes " + std::to_string(a) + " and " + std::to_string(b);
}

ClassTable table_of(const Rows& rows, const Fail& fail) {
    const std::size_t count = rows.size();
    if (count == 0 || count > kMaxClasses) {
        fail("a table of distances has 1 to 8 rows, not " + std::to_string(count));
    }
    ClassTable table{count, {}};
    for (std::size_t a = 0; a < count; ++a) {
        if (rows[a].size() != count) {
            fail("row " + std::to_string(a) + " of the table has " +
                 counted(rows[a].size(), "distance", "distances") + ", but there are " +
                 counted(count, "row", "rows"));
        }
        for (std::size_t b = 0; b < count; ++b) {
            const double distance = rows[a][b] + 0.0; // -0 is 0.
            const bool is_free = a != b && distance == 0;
            if (!is_free && (!(distance > 0) || !std::isfinite(distance))) {
                fail("the distance " + entry_text(a, b) + " is " + exact_text(distance) +
                     ", not positive and finite" + (a == b ? "" : ", nor 0 for none"));
            }
            if (b < a && distance != rows[b][a]) {
                fail("the table is not symmetric: the distance " + entry_text(b, a) + " is " +
                     exact_text(rows[b][a]) + " and " + exact_text(distance));
            }
            table.distances.push_back(distance);
        }
    }
    double least = table.largest();
    for (const double distance : table.distances) {
        least = distance == 0 ? least : std::min(least, distance);
    }
    if (least < table.largest() * double{kMinClassFactor}) {
        fail("the distances " + exact_text(least) + " and " + exact_text(table.largest()) +
             " differ by more than a factor of 100");
    }
    return table;
}

ClassTable table_in_file(const std::string& path) {
    const std::string text = read_text(path);
    Rows rows;
    TextLines lines(text);
    for (std::string_view line; lines.next(line);) {
        std::string own(without_comment(line));
        std::ranges::replace(own, ';', ',');
        std::vector<double> row = numbers_in(own, [&](const std::string& message) {
            fail_input(path, "line " + std::to_string(lines.number()) + ": " + message);
        });
        if (!row.empty()) {
            rows.push_back(std::move(row));
        }
    }
    return table_of(rows, [&](const std::string& message) { fail_input(path, message); });
}

ClassTable table_in_text(const std::string& text) {
    const auto fail = [](const std::string& message) { fail_usage("--classes: " + message); };
    Rows rows;
    for (std::string_view rest = text;;) {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        rows.push_back(numbers_in(rest.substr(0, end), fail));
        if (end == rest.size()) {
            return table_of(rows, fail);
        }
        rest.remove_prefix(end + 1);
    }
}

} // namespace

float class_factor(double factor) {
    return factor == 0 ? 0 : std::max(static_cast<float>(factor), kMinClassFactor);
}

double ClassTable::largest() const {
    return std::ranges::max(distances);
}

double ClassTable::factor(std::size_t a, std::size_t b) const {
    if (!distances.empty()) {
        return distances[count * a + b] / largest();
    }
    // The union of all classes is then as dense as count samples for each one of a class.
    return a == b ? 1 : 1 / std::sqrt(static_cast<double>(count));
}

bool ClassTable::has_radii() const {
    for (std::size_t a = 0; a < count; ++a) {
        if (factor(a, a) != 1) {
            return true;
        }
    }
    return false;
}

ClassDistances ClassTable::in_mesh_units(double min_distance) const {
    ClassDistances all;
    all.count = count > 1 ? count : 0;
    for (std::size_t a = 0; a < all.count; ++a) {
        for (std::size_t b = 0; b < all.count; ++b) {
            all.distances.push_back(distance(a, b, min_distance));
        }
    }
    return all;
}

std::vector<float> ClassTable::factors() const {
    std::vector<float> factors;
    for (std::size_t a = 0; a < count && count > 1; ++a) {
        for (std::size_t b = 0; b < count; ++b) {
            factors.push_back(class_factor(factor(a, b)));
        }
    }
    return factors;
}

std::string ClassTable::text(double min_distance) const {
    if (distances.empty()) {
        return std::to_string(count);
    }
    const bool is_scaled = min_distance != largest();
    std::string text;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        text += (i == 0           ? ""
                 : i % count == 0 ? ";"
                                  : ",") +
                exact_text(is_scaled ? distance(i / count, i % count, min_distance) : distances[i]);
    }
    return count == 1 ? text + ';' : text;
}

bool names_class_file(const std::string& text) {
    return text.find(';') == std::string::npos &&
           text.find_first_not_of("0123456789.eE+-, \t") != std::string::npos;
}

bool has_distances(const std::string& text) {
    return names_class_file(text) || text.find(';') != std::string::npos;
}

ClassTable parse_classes(const std::string& text) {
    if (text.empty()) {
        return {};
    }
    if (names_class_file(text)) {
        return table_in_file(text);
    }
    if (text.find(';') != std::string::npos) {
        return table_in_text(text.ends_with(';') ? text.substr(0, text.size() - 1) : text);
    }
    const auto count = parse_integer<std::size_t>(text);
    if (!count || *count < 1 || *count > kMaxClasses) {
        fail_usage("--classes: " + in_quotes(text) +
                   " is neither a number of classes from 1 to 8, nor a table of distances such as "
                   "0.2,0.1;0.1,0.2, nor a file");
    }
    return {*count, {}};
}

OfClass parse_of_class(const std::string& option, const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto number = colon == std::string::npos
                            ? std::nullopt
                            : parse_integer<std::uint8_t>(text.substr(0, colon));
    if (!number || *number >= kMaxClasses || colon + 1 == text.size()) {
        fail_usage(option + ": " + in_quotes(text) +
                   " does not begin with a class from 0 to 7 and a colon, such as 0:...");
    }
    return {*number, text.substr(colon + 1)};
}

void check_of_class(const std::string& option, const OfClass& own, std::size_t count) {
    if (count < 2) {
        fail_usage(option + " is for classes, two or more; add --classes");
    }
    if (own.number >= count) {
        fail_usage(option + ": there is no class " + std::to_string(own.number) +
                   "; --classes has " + std::to_string(count) + ", numbered from 0");
    }
}

void add_class_file(const std::string& text, std::vector<NamedFile>& read) {
    if (names_class_file(text)) {
        read.push_back({"the table of classes", text});
    }
}

void place_class_file(std::string& text,
                      const std::function<std::string(const std::string&)>& place) {
    if (names_class_file(text)) {
        text = place(text);
    }
}

void add_class_option(Command command, std::string& text, OptionUse use, const std::string& group) {
    command.add_option("--classes", text, "K|TABLE",
                       help_for(use, "Spread 1 to 8 classes of samples, each and all together\n",
                                "Check 1 to 8 classes of samples, each and all together\n") +
                           "(column class). K: each at the minimum distance D, samples\n"
                           "of two classes at D / sqrt(K). TABLE: a symmetric table of\n"
                           "distances, as 0.2,0.1;0.1,0.3 or in a file; 0 for two classes\n"
                           "that keep no distance",
                       group);
}

} // namespace geodisk::tools
