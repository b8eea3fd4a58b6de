// Rows of sample files from columns that stand anywhere, for the readers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "files/meshes/part_columns.hpp"
#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

/// Columns of a sample in the file.
struct ColumnPlaces {
    std::array<std::optional<std::size_t>, kSampleColumnNames.size()> named;
    std::vector<std::size_t> coordinates;
    bool is_numbered = false; ///< The coordinates are x0 x1 ... rather than x y z.
    bool has_faces = false;   ///< Faces and weights are there.

    std::uint32_t dimension() const { return static_cast<std::uint32_t>(coordinates.size()); }
};

/// Domain that samples lie in, which decides what columns must be there.
enum class SampleDomain { surface, box };

/// Returns where the column of a name stands, if the file has it.
using PlaceOf = std::function<std::optional<std::size_t>(std::string_view name)>;

/// Throws UserError(bad_input) for a column that is missing.
ColumnPlaces find_places(const Path& path, SampleDomain domain, const PlaceOf& place_of);

/// Returns false if `value` is no index.
bool set_index(std::uint32_t& index, double value);

/// Returns false if `value` makes no sense in that column, which is no coordinate.
bool set_value(SampleRow& row, SampleColumn column, double value);

/// Returns the row whose column i has the value `value_at(place)`; `fail(message)` must not return.
template <typename ValueAt, typename Fail>
SampleRow make_row(const ColumnPlaces& places, const ValueAt& value_at, const Fail& fail) {
    SampleRow row;
    for (std::size_t axis = 0; axis < places.coordinates.size(); ++axis) {
        row.position[axis] = value_at(places.coordinates[axis]);
        if (!std::isfinite(row.position[axis])) {
            fail(std::string(places.is_numbered ? kNumberedColumnNames[axis]
                                                : kSampleColumnNames[axis]) +
                 (std::isnan(row.position[axis]) ? " is no number" : " is out of range"));
        }
    }
    for (std::size_t i = 0; i < places.named.size(); ++i) {
        if (places.named[i] && !set_value(row, SampleColumn{i}, value_at(*places.named[i]))) {
            fail(std::string(kSampleColumnNames[i]) + " is out of range");
        }
    }
    return row;
}

/// Keeps the columns that part_columns() makes, of existing samples and of levels, where a file has
/// them and they hold whole numbers.
class ExtraReader {
  public:
    /// Reads the column `numbers` too, if that is not "". Throws UserError(bad_input) without it.
    ExtraReader(const Path& path, const PlaceOf& place_of, const std::string& numbers) {
        if (!numbers.empty()) {
            number_place_ = place_of(numbers);
            if (!number_place_) {
                fail_input(path, "has no column " + numbers);
            }
        }
        std::vector<std::string> names = part_column_names();
        names.emplace_back(kExistingColumn);
        names.emplace_back(kClassColumn);
        names.emplace_back(kFeatureColumn);
        names.emplace_back(kLevelColumn);
        names.emplace_back(kVertexColumn);
        names.emplace_back(kLineColumn);
        for (const std::string& name : names) {
            if (const std::optional<std::size_t> place = place_of(name)) {
                places_.push_back(*place);
                columns_.push_back({name, {}});
            }
        }
    }

    /// `value_at(place)` may be nothing, which is no number.
    template <typename ValueAt>
    void add_row(const ValueAt& value_at) {
        if (number_place_) {
            const std::optional<double> number = value_at(*number_place_);
            numbers_.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        for (std::size_t i = 0; i < places_.size();) {
            const std::optional<double> value = value_at(places_[i]);
            const std::string& name = columns_[i].name;
            std::uint32_t index = 0;
            if (value && set_index(index, *value) && index <= largest_in_column(name)) {
                columns_[i++].values.push_back(index);
            } else { // A column of that name from some other program, or a damaged one.
                wrong_.push_back({name, columns_[i].values.size()});
                places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
                columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
    }

    /// Hands over what was read.
    void move_to(SampleFile& samples) && {
        samples.extra = std::move(columns_);
        samples.numbers = std::move(numbers_);
        samples.wrong_columns = std::move(wrong_);
    }

  private:
    std::vector<std::size_t> places_;
    std::vector<ExtraColumn> columns_;
    std::vector<WrongColumn> wrong_;
    std::optional<std::size_t> number_place_;
    std::vector<double> numbers_;
};

/// Adds "KEY: VALUE" or "KEY:" of a comment; other comments are ignored.
void add_entry(SampleHeader& header, std::string_view comment);

/// Takes the number of samples out of the header. Throws UserError(bad_input) if there are more or
/// fewer.
void check_sample_count(const Path& path, SampleFile& samples);

/// Throws UserError(bad_input) if the last line of a text of samples has no end, so that the file
/// may be cut short.
void check_last_line(const Path& path, std::string_view text);

/// The readers of single formats, as SampleReader says.
SampleFile read_ply_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers);
SampleFile read_table_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                              const std::string& numbers);
SampleFile read_pcd_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers);
SampleFile read_obj_points(const Path& path, std::string&& bytes, SampleDomain domain,
                           const std::string& numbers);
SampleFile read_numpy_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                              const std::string& numbers);

SampleFile read_vtp_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers);

SampleFile read_gltf_lines(const Path& path, const FileScope& scope);

/// Returns true for the bytes of an .npy or an .npz file.
bool is_of_numpy(std::string_view bytes);

} // namespace geodisk::tools
