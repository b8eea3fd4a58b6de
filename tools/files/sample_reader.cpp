#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/part_columns.hpp"
#include "files/ply_file.hpp"
#include "files/sample_columns.hpp"
#include "files/sample_file.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Where each column of a sample stands in the file.
struct ColumnPlaces {
    std::array<std::optional<std::size_t>, kSampleColumnNames.size()> named;
    std::vector<std::size_t> coordinates;
    bool is_numbered = false; ///< The coordinates are x0 x1 ... rather than x y z.

    std::uint32_t dimension() const { return static_cast<std::uint32_t>(coordinates.size()); }
};

bool is_coordinate(SampleColumn column) {
    return column <= SampleColumn::z;
}

bool is_required(SampleColumn column) {
    return column >= SampleColumn::face_index && column <= SampleColumn::bary_w;
}

/// What samples lie in, and so what columns must be there.
enum class Domain { surface, box };

/// x0 x1 ... as far as they go; `place_of(name)` is where the column of that name stands, if the
/// file has it.
template <typename PlaceOf>
void find_numbered(const Path& path, const PlaceOf& place_of, ColumnPlaces& places) {
    for (const std::string_view name : kNumberedColumnNames) {
        const std::optional<std::size_t> place = place_of(name);
        if (!place) {
            break;
        }
        places.coordinates.push_back(*place);
    }
    places.is_numbered = !places.coordinates.empty();
    if (places.is_numbered && places.coordinates.size() < 3) {
        fail_input(path,
                   "has no column " + std::string(kNumberedColumnNames[places.coordinates.size()]));
    }
}

/// x y z: on a surface all or none, in a box the first ones, as many as it has.
template <typename PlaceOf>
void find_named(const Path& path, Domain domain, const PlaceOf& place_of, ColumnPlaces& places) {
    std::string_view missing;
    for (const SampleColumn column : {SampleColumn::x, SampleColumn::y, SampleColumn::z}) {
        const std::string_view name = kSampleColumnNames[static_cast<std::size_t>(column)];
        const std::optional<std::size_t> found = place_of(name);
        if (found && missing.empty()) {
            places.coordinates.push_back(*found);
        } else if (found) {
            fail_input(path, "has no column " + std::string(missing));
        } else if (missing.empty()) {
            missing = name;
        }
    }
    const bool is_short = domain == Domain::box ? places.coordinates.empty()
                                                : !places.coordinates.empty() && !missing.empty();
    if (is_short) {
        fail_input(path, "has no column " + std::string(missing));
    }
}

template <typename PlaceOf>
ColumnPlaces find_places(const Path& path, Domain domain, const PlaceOf& place_of) {
    ColumnPlaces places;
    find_numbered(path, place_of, places);
    for (std::size_t i = 0; i < kSampleColumnNames.size(); ++i) {
        if (is_coordinate(SampleColumn{i})) {
            continue;
        }
        places.named[i] = place_of(kSampleColumnNames[i]);
        if (!places.named[i] && domain == Domain::surface && is_required(SampleColumn{i})) {
            fail_input(path, "has no column " + std::string(kSampleColumnNames[i]));
        }
    }
    if (!places.is_numbered) {
        find_named(path, domain, place_of, places);
    }
    return places;
}

bool set_index(std::uint32_t& index, double value) {
    if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max())) {
        return false;
    }
    index = static_cast<std::uint32_t>(value);
    return static_cast<double>(index) == value;
}

/// False if `value` makes no sense in that column, which is no coordinate.
bool set_value(SampleRow& row, SampleColumn column, double value) {
    if (column == SampleColumn::face_index) {
        return set_index(row.face, value);
    }
    if (column == SampleColumn::polygon_index) {
        return set_index(row.polygon.emplace(), value);
    }
    if (column == SampleColumn::radius) {
        row.radius = value;
        return value > 0 && std::isfinite(value);
    }
    const bool is_weight = column >= SampleColumn::bary_u;
    const SampleColumn first = is_weight ? SampleColumn::bary_u : SampleColumn::nx;
    const std::size_t i = static_cast<std::size_t>(column) - static_cast<std::size_t>(first);
    (is_weight ? row.bary : row.normal)[i] = static_cast<float>(value);
    return std::isfinite(value);
}

/// The row whose column i has the value `value_at(place)`; `fail(name)` must not return.
template <typename ValueAt, typename Fail>
SampleRow make_row(const ColumnPlaces& places, const ValueAt& value_at, const Fail& fail) {
    SampleRow row;
    for (std::size_t axis = 0; axis < places.coordinates.size(); ++axis) {
        row.position[axis] = value_at(places.coordinates[axis]);
        if (!std::isfinite(row.position[axis])) {
            fail(std::string(places.is_numbered ? kNumberedColumnNames[axis]
                                                : kSampleColumnNames[axis]) +
                 " is out of range");
        }
    }
    for (std::size_t i = 0; i < places.named.size(); ++i) {
        if (places.named[i] && !set_value(row, SampleColumn{i}, value_at(*places.named[i]))) {
            fail(std::string(kSampleColumnNames[i]) + " is out of range");
        }
    }
    return row;
}

/// Keeps the columns that part_columns() makes, where a file has them and they hold whole numbers.
class ExtraReader {
  public:
    template <typename PlaceOf>
    explicit ExtraReader(const PlaceOf& place_of) {
        for (const std::string& name : part_column_names()) {
            if (const std::optional<std::size_t> place = place_of(name)) {
                places_.push_back(*place);
                columns_.push_back({name, {}});
            }
        }
    }

    /// `value_at(place)` may be nothing, which is no number.
    template <typename ValueAt>
    void add_row(const ValueAt& value_at) {
        for (std::size_t i = 0; i < places_.size();) {
            const std::optional<double> value = value_at(places_[i]);
            std::uint32_t index = 0;
            if (value && set_index(index, *value)) {
                columns_[i++].values.push_back(index);
            } else { // A column of that name from some other program.
                places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
                columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
    }

    std::vector<ExtraColumn> columns() && { return std::move(columns_); }

  private:
    std::vector<std::size_t> places_;
    std::vector<ExtraColumn> columns_;
};

void add_entry(SampleHeader& header, std::string_view comment) {
    if (const std::size_t colon = comment.find(": "); colon != std::string_view::npos) {
        header.entries.emplace_back(comment.substr(0, colon), comment.substr(colon + 2));
    }
}

SampleFile read_ply_samples(const Path& path, Domain domain) {
    PlyFile file(path);
    SampleFile samples;
    for (const std::string& comment : file.comments()) {
        add_entry(samples.header, comment);
    }
    bool has_vertices = false;
    for (const PlyElement& element : file.elements()) {
        if (element.name != "vertex") {
            file.read_records(element, [](std::uint64_t, const PlyRecord&) {});
            continue;
        }
        file.check_unique(element);
        has_vertices = true;
        const auto place_of = [&](std::string_view name) { return element.find_scalar(name); };
        const ColumnPlaces places = find_places(path, domain, place_of);
        ExtraReader extra(place_of);
        samples.dimension = places.dimension();
        samples.rows.reserve(file.possible_records(element));
        file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
            samples.rows.push_back(make_row(
                places, [&](std::size_t place) { return record.scalars[place]; },
                [&](const std::string& message) { file.fail(element, index, message); }));
            extra.add_row([&](std::size_t place) { return std::optional(record.scalars[place]); });
        });
        samples.extra = std::move(extra).columns();
    }
    if (!has_vertices) {
        fail_input(path, "has no element vertex");
    }
    if (file.trailing_bytes() > 0) {
        fail_input(path, "has data after the last sample");
    }
    return samples;
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    std::size_t comma = 0;
    while ((comma = line.find(',')) != std::string_view::npos) {
        cells.push_back(trimmed(line.substr(0, comma)));
        line.remove_prefix(comma + 1);
    }
    cells.push_back(trimmed(line));
}

/// Reads a CSV sample file line by line.
class CsvReader {
  public:
    CsvReader(const Path& path, Domain domain)
        : path_(path), domain_(domain), bytes_(read_text(path)), position_(text_begin(bytes_)) {}

    SampleFile read() {
        SampleFile samples;
        ColumnPlaces places;
        std::optional<ExtraReader> extra;
        std::size_t column_count = 0;
        while (next_row(samples.header)) {
            if (column_count == 0) {
                column_count = cells_.size();
                places = find_places(path_, domain_, place_of());
                extra.emplace(place_of());
                samples.dimension = places.dimension();
                continue;
            }
            if (cells_.size() != column_count) {
                fail("has " + std::to_string(cells_.size()) + " columns instead of " +
                     std::to_string(column_count));
            }
            samples.rows.push_back(make_row(
                places, [this](std::size_t place) { return value_at(place); },
                [this](const std::string& message) { fail(message); }));
            extra->add_row([this](std::size_t place) { return parse_real(cells_[place]); });
        }
        if (column_count == 0) {
            fail_input(path_, "has no header row");
        }
        samples.extra = std::move(*extra).columns();
        return samples;
    }

  private:
    /// Fills cells_ from the next line that is neither blank nor a comment.
    bool next_row(SampleHeader& header) {
        while (position_ < bytes_.size()) {
            const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
            std::string_view line(bytes_.data() + position_, end - position_);
            position_ = end + 1;
            ++line_;
            line = trimmed(line.substr(0, line.ends_with('\r') ? line.size() - 1 : line.size()));
            if (line.starts_with('#')) {
                add_entry(header, trimmed(line.substr(1)));
            } else if (!line.empty()) {
                split_cells(line, cells_);
                return true;
            }
        }
        return false;
    }

    /// Finds columns in the header row.
    std::function<std::optional<std::size_t>(std::string_view)> place_of() const {
        return [this](std::string_view name) {
            const auto cell = std::find(cells_.begin(), cells_.end(), name);
            return cell == cells_.end()
                       ? std::nullopt
                       : std::optional(static_cast<std::size_t>(cell - cells_.begin()));
        };
    }

    double value_at(std::size_t place) const {
        const std::optional<double> value = parse_real(cells_[place]);
        if (!value) {
            fail(in_quotes(cells_[place]) + " is not a number");
        }
        return *value;
    }

    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(line_) + ": " + message);
    }

    const Path& path_;
    Domain domain_;
    std::string bytes_;
    std::size_t position_;
    std::size_t line_ = 0;
    std::vector<std::string_view> cells_;
};

SampleFile read_in(const Path& path, Domain domain) {
    const std::string extension = lower_extension(path);
    if (extension == ".ply") {
        return read_ply_samples(path, domain);
    }
    if (extension == ".csv") {
        return CsvReader(path, domain).read();
    }
    if (extension == ".xyz" || extension == ".obj") {
        fail_input(path, "an " + extension +
                             (domain == Domain::surface
                                  ? " file has no face_index and bary columns; use .ply or .csv"
                                  : " file does not tell of its box; use .ply or .csv"));
    }
    for (const char* const written : {".pcd", ".npz", ".gltf", ".glb"}) {
        if (extension == written) {
            fail_input(path, "geodisk writes samples as " + extension +
                                 " but does not read them back; use .ply or .csv");
        }
    }
    fail_input(path, "unknown sample format; known are .ply and .csv");
}

} // namespace

SampleFile read_samples(const Path& path) {
    return read_in(path, Domain::surface);
}

SampleFile read_box_samples(const Path& path) {
    return read_in(path, Domain::box);
}

} // namespace geodisk::tools
