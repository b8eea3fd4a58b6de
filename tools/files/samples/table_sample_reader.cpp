// Samples in tables of text: CSV of geodisk, and points of other programs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/obj_lines.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/samples/table_cells.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

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

/// Returns true for the number of a chemical element.
bool is_element(double number) {
    return number >= 1 && number <= 118 && number == std::floor(number);
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
            split(line);
            if (columns_ == 0) {
                begin();
            } else {
                add_row();
            }
        }
        if (columns_ == 0 && promised_ != 0) {
            fail_input(path_, "has no header row");
        }
        check_last_line(path_, bytes_);
        if (promised_ && *promised_ != samples_.rows.size()) {
            fail_input(path_, "has " + counted(samples_.rows.size(), "point", "points") +
                                  ", but its first line says " + grouped(*promised_) +
                                  "; the file may be cut short");
        }
        if (may_be_elements_ && !samples_.rows.empty()) {
            fail_input(path_, "its first column may be x or the numbers of elements; name the "
                              "columns in its second line, such as 'element x y z'");
        }
        check_sample_count(path_, samples_);
        if (extra_) {
            std::move(*extra_).move_to(samples_);
        }
        return std::move(samples_);
    }

  private:
    /// The next line that is neither blank nor a comment, whose entry is noted.
    bool next_line(std::string_view& line) {
        while (lines_.next(line)) {
            const std::string_view text = trimmed(line);
            if (text.starts_with('#')) {
                add_entry(samples_.header, trimmed(text.substr(1)));
            } else if (!text.empty()) {
                return true;
            }
        }
        return false;
    }

    /// Splits a line into cells, with those that follow while a quoted cell has no end.
    void split(std::string_view line) {
        const std::uint32_t first = lines_.number();
        bool is_joined = false;
        while (split_cells(line, separator_, columns_, cells_)) {
            if (!std::exchange(is_joined, true)) {
                joined_ = line;
            }
            std::string_view more;
            if (!lines_.next(more)) {
                fail_at(first, "a quotation mark has no end");
            }
            joined_ += '\n';
            joined_ += more;
            line = joined_;
        }
    }

    bool are_numbers(const Cells& cells) const {
        return std::ranges::all_of(
            cells, [&](auto cell) { return number_in(cell, separator_).has_value(); });
    }

    /// Returns true for a row of the XYZ format of molecules: an element, and a place behind it.
    bool is_atom(const Cells& cells) const {
        return cells.size() > 3 && !number_in(cells[0], separator_) &&
               are_numbers({cells.begin() + 1, cells.begin() + 4});
    }

    /// The first line names the columns, or holds the first numbers, or just how many points there
    /// are.
    void begin() {
        if (cells_.size() == 1 && !promised_ &&
            (promised_ = parse_integer<std::size_t>(cells_[0]))) {
            separator_ = 0;
            skip_remark();
            return;
        }
        const bool has_element = promised_ && is_atom(cells_);
        const bool is_row = has_element || are_numbers(cells_);
        columns_ = cells_.size();
        std::vector<std::string> names{"x", "y", "z"};
        if (has_element) {
            names.insert(names.begin(), "element");
        } else if (!is_row) {
            std::ranges::transform(cells_, (names.clear(), std::back_inserter(names)), column_name);
        } else if (columns_ < 3) {
            fail("has no header row, and fewer than three numbers");
        }
        may_be_elements_ = may_be_elements_ && is_row && !has_element && columns_ > 3;
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

    /// Skips the remark that follows the number of points in the XYZ format of molecules.
    void skip_remark() {
        TextLines ahead = lines_;
        if (std::string_view line; ahead.next(line) && is_remark(line, ahead)) {
            lines_ = ahead;
            may_be_elements_ = true;
        }
    }

    /// Returns true for a line that neither names columns nor is a comment or one of the rows.
    /// `rest` is what follows it.
    bool is_remark(std::string_view line, TextLines rest) const {
        if (trimmed(line).starts_with('#')) {
            return false;
        }
        Cells cells, next;
        static_cast<void>(split_cells(line, separator_of(line), 0, cells));
        if (cells.empty()) {
            return true;
        }
        const auto is_named = [&](std::string_view axis) {
            return std::ranges::find(cells, axis, column_name) != cells.end();
        };
        std::size_t rows = 0;
        for (std::string_view row; rest.next(row);) {
            if (!trimmed(row).empty() && rows++ == 0) {
                static_cast<void>(split_cells(row, kBlanks, 0, next));
            }
        }
        const bool is_row =
            is_atom(cells) ? rows < *promised_ : are_numbers(cells) && !is_atom(next);
        return !is_row && !(is_named("x") && is_named("y") && is_named("z"));
    }

    void add_row() {
        if (cells_.size() != columns_) {
            fail("has " + std::to_string(cells_.size()) + " columns instead of " +
                 std::to_string(columns_));
        }
        samples_.rows.push_back(make_row(
            places_, [this](std::size_t place) { return value_at(place); },
            [this](const std::string& message) { fail(message); }));
        const std::optional<double> first = number_in(cells_[0], separator_);
        may_be_elements_ = may_be_elements_ && first && is_element(*first);
        extra_->add_row([this](std::size_t place) { return number_in(cells_[place], separator_); });
    }

    double value_at(std::size_t place) const {
        const std::optional<double> value = number_in(cells_[place], separator_);
        if (!value) {
            fail(in_quotes(cells_[place]) + " is not a number");
        }
        return *value;
    }

    [[noreturn]] void fail(const std::string& message) const { fail_at(lines_.number(), message); }
    [[noreturn]] void fail_at(std::uint32_t line, const std::string& message) const {
        fail_input(path_, "line " + std::to_string(line) + ": " + message);
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
    bool may_be_elements_ = false; ///< The first column, as of molecules by atomic numbers.
    std::string joined_;           ///< Lines of a quoted cell.
    char separator_ = 0;
    Cells cells_;
};

} // namespace

SampleFile read_table_samples(const Path& path, std::string&& bytes, SampleDomain domain,
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

SampleFile read_obj_points(const Path& path, std::string&& bytes, SampleDomain /*domain*/,
                           const std::string& numbers) {
    if (!numbers.empty()) {
        fail_input(path, "has no columns, so none of the name " + numbers);
    }
    SampleFile samples;
    samples.has_faces = false;
    TextLines all(bytes);
    for (std::string_view line; all.next(line);) {
        if (line.starts_with('#')) {
            add_entry(samples.header, trimmed(line.substr(1)));
        }
    }
    ObjLines lines(bytes);
    Cells cells;
    for (std::string_view line; lines.next(line);) {
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
