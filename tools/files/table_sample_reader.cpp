// Samples in tables of text: CSV of geodisk, and points of other programs.
#include <algorithm>
#include <cctype>
#include <span>

#include "files/input_file.hpp"
#include "files/sample_rows.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Cells = std::vector<std::string_view>;

/// What stands between the numbers of a line; '\t' for blanks and tabs alike.
char separator_of(std::string_view line) {
    for (const char separator : {';', ','}) {
        if (line.find(separator) != std::string_view::npos) {
            return separator;
        }
    }
    return '\t';
}

void split_cells(std::string_view line, char separator, Cells& cells) {
    if (separator == '\t') {
        split_tokens(line, cells);
        return;
    }
    cells.clear();
    for (bool more = true; more;) {
        const std::size_t end = line.find(separator);
        more = end != std::string_view::npos;
        std::string_view cell = trimmed(line.substr(0, end));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') {
            cell = cell.substr(1, cell.size() - 2);
        }
        cells.push_back(cell);
        line.remove_prefix(more ? end + 1 : line.size());
    }
}

/// A number; where semicolons part the cells, a comma may be its decimal point.
std::optional<double> number_in(std::string_view cell, char separator) {
    std::string text(cell);
    if (separator == ';') {
        std::ranges::replace(text, ',', '.');
    }
    return parse_real(text);
}

/// The name of a column as geodisk writes it: CloudCompare writes "//X", ParaView "Points:0".
std::string column_name(std::string_view cell) {
    std::string name = lower_case(std::string(cell));
    name.erase(0, std::min(name.find_first_not_of("/ "), name.size()));
    for (const auto& [theirs, ours] :
         {std::pair{"points:0", "x"}, {"points:1", "y"}, {"points:2", "z"}}) {
        if (name == theirs) {
            return ours;
        }
    }
    return name;
}

class TableReader {
  public:
    TableReader(const Path& path, std::string_view bytes, SampleDomain domain,
                const std::string& numbers)
        : path_(path), bytes_(bytes), domain_(domain), numbers_(column_name(numbers)),
          lines_(bytes) {}

    SampleFile read() {
        std::string_view line;
        while (next_line(line)) {
            if (separator_ == 0) {
                separator_ = separator_of(line);
            }
            split_cells(line, separator_, cells_);
            if (columns_ == 0) {
                begin();
            } else {
                add_row();
            }
        }
        if (columns_ == 0) {
            fail_input(path_, "has no header row");
        }
        check_last_line(path_, bytes_);
        if (promised_ && *promised_ != samples_.rows.size()) {
            fail_input(path_, "has " + counted(samples_.rows.size(), "point", "points") +
                                  ", but its first line says " + grouped(*promised_) +
                                  "; the file may be cut short");
        }
        check_sample_count(path_, samples_);
        std::move(*extra_).move_to(samples_);
        return std::move(samples_);
    }

  private:
    /// The next line that is neither blank nor a comment, whose entry is noted.
    bool next_line(std::string_view& line) {
        while (lines_.next(line)) {
            line = trimmed(line);
            if (line.starts_with('#')) {
                add_entry(samples_.header, trimmed(line.substr(1)));
            } else if (!line.empty()) {
                return true;
            }
        }
        return false;
    }

    /// The first line names the columns, or holds the first numbers, or just how many points there
    /// are.
    void begin() {
        const bool is_row = std::ranges::all_of(
            cells_, [&](auto cell) { return number_in(cell, separator_).has_value(); });
        if (is_row && cells_.size() == 1 && !promised_) {
            promised_ = parse_integer<std::size_t>(cells_[0]);
            separator_ = 0;
            if (promised_) {
                return;
            }
        }
        columns_ = cells_.size();
        std::vector<std::string> names{"x", "y", "z"};
        if (!is_row) {
            std::ranges::transform(cells_, (names.clear(), std::back_inserter(names)), column_name);
        } else if (columns_ < 3) {
            fail("has no header row, and fewer than three numbers");
        }
        const auto place_of = [&](std::string_view name) {
            const auto found = std::ranges::find(names, name);
            return found == names.end()
                       ? std::nullopt
                       : std::optional(static_cast<std::size_t>(found - names.begin()));
        };
        places_ = find_places(path_, domain_, place_of);
        extra_.emplace(path_, place_of, numbers_);
        samples_.dimension = places_.dimension();
        samples_.has_faces = places_.has_faces;
        if (is_row) {
            add_row();
        }
    }

    void add_row() {
        if (cells_.size() != columns_) {
            fail("has " + std::to_string(cells_.size()) + " columns instead of " +
                 std::to_string(columns_));
        }
        samples_.rows.push_back(make_row(
            places_, [this](std::size_t place) { return value_at(place); },
            [this](const std::string& message) { fail(message); }));
        extra_->add_row([this](std::size_t place) { return number_in(cells_[place], separator_); });
    }

    double value_at(std::size_t place) const {
        const std::optional<double> value = number_in(cells_[place], separator_);
        if (!value) {
            fail(in_quotes(cells_[place]) + " is not a number");
        }
        return *value;
    }

    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(lines_.number()) + ": " + message);
    }

    const Path& path_;
    std::string_view bytes_;
    SampleDomain domain_;
    std::string numbers_;
    TextLines lines_;
    SampleFile samples_;
    ColumnPlaces places_;
    std::optional<ExtraReader> extra_;
    std::size_t columns_ = 0; ///< 0 before the first line.
    std::optional<std::size_t> promised_;
    char separator_ = 0;
    Cells cells_;
};

} // namespace

SampleFile read_table_samples(const Path& path, std::string_view bytes, SampleDomain domain,
                              const std::string& numbers) {
    return TableReader(path, bytes, domain, numbers).read();
}

namespace {

/// Adds a polyline of OBJ, whose vertices may have indices of texture coordinates behind a slash.
template <typename Fail>
void add_line(const Cells& cells, const Fail& fail, SampleFile& samples) {
    std::optional<std::uint32_t> last;
    for (const std::string_view cell : std::span(cells).subspan(1)) {
        const auto index = parse_integer<std::int64_t>(cell.substr(0, cell.find('/')));
        const auto count = static_cast<std::int64_t>(samples.rows.size());
        const std::int64_t vertex = index.value_or(0) < 0 ? count + *index : index.value_or(0) - 1;
        if (!index || vertex < 0 || vertex >= count) {
            fail(in_quotes(cell) + " is not one of the " +
                 counted(samples.rows.size(), "vertex", "vertices") + " before it");
        }
        const auto row = static_cast<std::uint32_t>(vertex);
        if (last) {
            samples.segments.push_back({*last, row});
        }
        last = row;
    }
}

} // namespace

SampleFile read_obj_points(const Path& path, std::string_view bytes) {
    SampleFile samples;
    samples.has_faces = false;
    TextLines lines(bytes);
    Cells cells;
    for (std::string_view line; lines.next(line);) {
        if (line.starts_with('#')) {
            add_entry(samples.header, trimmed(line.substr(1)));
        }
        split_tokens(line, cells);
        const auto fail = [&](const std::string& message) {
            fail_input(path, "line " + std::to_string(lines.number()) + ": " + message);
        };
        if (!cells.empty() && cells[0] == "f") {
            fail("a face, so this is a mesh and no file of samples");
        }
        if (!cells.empty() && cells[0] == "l") {
            add_line(cells, fail, samples);
        }
        if (cells.size() < 4 || cells[0] != "v") {
            continue;
        }
        SampleRow& row = samples.rows.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto value = parse_real(cells[axis + 1]);
            if (!value || !std::isfinite(*value)) {
                fail(in_quotes(cells[axis + 1]) + " is not a number");
            }
            row.position[axis] = *value;
        }
    }
    check_last_line(path, bytes);
    return samples;
}

} // namespace geodisk::tools
