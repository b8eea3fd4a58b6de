// Samples in arrays of numpy: .npz of geodisk, and points of other programs as .npz and .npy.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "files/archives/numpy_array.hpp"
#include "files/archives/zip_reader.hpp"
#include "files/samples/sample_rows.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kZip = "PK\x03\x04", kEmptyZip = "PK\x05\x06", kNpy = "\x93NUMPY";

struct NamedArray {
    std::string name; ///< "" for the array of an .npy file.
    NumpyArray array;
};

/// Returns the names of the columns of the arrays that geodisk writes as tables; none for others.
std::vector<std::string_view> column_names(std::string_view array, std::size_t columns) {
    const auto named = [](SampleColumn first, std::size_t count) {
        const auto* const begin = kSampleColumnNames.data() + static_cast<std::size_t>(first);
        return std::vector<std::string_view>(begin, begin + count);
    };
    if (array == "points" && columns > 3) {
        return {kNumberedColumnNames.begin(),
                kNumberedColumnNames.begin() + static_cast<std::ptrdiff_t>(columns)};
    }
    if (array == "points") {
        return named(SampleColumn::x, columns);
    }
    if (array == "normals" && columns == 3) {
        return named(SampleColumn::nx, columns);
    }
    if (array == "barycentric" && columns == 3) {
        return named(SampleColumn::bary_u, columns);
    }
    return {};
}

class NumpyReader {
  public:
    NumpyReader(const Path& path, SampleDomain domain, const std::string& numbers)
        : path_(path), domain_(domain), numbers_(numbers) {}

    SampleFile read(std::vector<NamedArray> arrays) {
        arrays_ = std::move(arrays);
        name_points();
        add_columns();
        add_header();
        const auto place_of = [this](std::string_view name) { return this->place_of(name); };
        const ColumnPlaces places = find_places(path_, domain_, place_of);
        ExtraReader extra(path_, place_of, numbers_);
        samples_.dimension = places.dimension();
        samples_.has_faces = places.has_faces;
        samples_.rows.reserve(rows_);
        for (std::size_t row = 0; row < rows_; ++row) {
            const auto value_at = [&](std::size_t place) {
                return columns_[place].array->at(row, columns_[place].index);
            };
            samples_.rows.push_back(make_row(places, value_at, [&](const std::string& message) {
                fail_input(path_, "row " + std::to_string(row) + ": " + message);
            }));
            extra.add_row([&](std::size_t place) { return std::optional(value_at(place)); });
        }
        std::move(extra).move_to(samples_);
        drop_equal_radii();
        return std::move(samples_);
    }

  private:
    struct Column {
        std::string_view name;
        const NumpyArray* array;
        std::size_t index;
    };

    NamedArray* find(std::string_view name) {
        const auto found = std::ranges::find(arrays_, name, &NamedArray::name);
        return found == arrays_.end() ? nullptr : &*found;
    }

    std::string contents() const {
        std::string text;
        for (const auto& [name, array] : arrays_) {
            text += (text.empty() ? "" : ", ") + (name.empty() ? "" : one_line(name) + " ") +
                    array.description();
        }
        return text;
    }

    /// Without an array points, or columns of a table, the only array of three columns has them.
    void name_points() {
        if (arrays_.size() == 1 && arrays_.front().array.shape().size() != 1) {
            arrays_.front().name = "points";
        }
        for (const std::string_view name : {"points", "x", "x0", "face_index"}) {
            if (find(name) != nullptr) {
                return;
            }
        }
        std::vector<NamedArray*> candidates;
        for (NamedArray& named : arrays_) {
            const auto& shape = named.array.shape();
            if (named.array.has_numbers() && shape.size() == 2 && shape[1] == 3) {
                candidates.push_back(&named);
            }
        }
        if (candidates.size() != 1) {
            fail_input(path_, "has no array points and " +
                                  std::string(candidates.empty() ? "none" : "several") +
                                  " of shape (n, 3), but " + contents() +
                                  "; save the positions as points");
        }
        candidates.front()->name = "points";
    }

    void add_columns() {
        if (const NamedArray* const points = find("points")) {
            check_points(points->array);
        }
        for (const std::string_view first : {"points", "x", "x0", "face_index"}) {
            if (const NamedArray* const array = find(first)) {
                rows_ = array->array.shape().empty() ? 0 : array->array.shape()[0];
                break;
            }
        }
        for (const auto& [name, array] : arrays_) {
            const auto& shape = array.shape();
            if (!array.has_numbers() || shape.empty() || shape.size() > 2) {
                continue;
            }
            std::vector<std::string_view> names{name};
            if (shape.size() == 2) {
                names = column_names(name, shape[1]);
            }
            const bool is_ours = std::ranges::any_of(
                names, [](auto one) { return std::ranges::count(kSampleColumnNames, one) > 0; });
            if (shape[0] == rows_) {
                for (std::size_t i = 0; i < names.size(); ++i) {
                    columns_.push_back({names[i], &array, i});
                }
            } else if (is_ours) {
                fail_input(path_, "array " + in_quotes(name) + " has " + grouped(shape[0]) +
                                      " rows, but there are " +
                                      counted(rows_, "sample", "samples"));
            }
        }
    }

    void check_points(const NumpyArray& points) const {
        const auto& shape = points.shape();
        constexpr std::size_t kMax = kNumberedColumnNames.size();
        if (!points.has_numbers() || shape.size() != 2 || shape[1] == 0 || shape[1] > kMax) {
            fail_input(path_, "its points are " + points.description() +
                                  "; save them as float64 of shape (n, 3)");
        }
    }

    /// Takes the entries of the array header, and the scalars that stand beside it.
    void add_header() {
        if (const NamedArray* const header = find("header")) {
            const auto entries =
                nlohmann::ordered_json::parse(header->array.text(), nullptr, false);
            for (const auto& [key, value] : entries.items()) {
                for (const auto& one : value.is_array() ? value : decltype(value){value}) {
                    add_text(key, one);
                }
            }
        }
        for (const char* const name : {"min_distance", "seed"}) {
            const NamedArray* const scalar = find(name);
            if (scalar != nullptr && scalar->array.has_numbers() && scalar->array.shape().empty() &&
                samples_.header.find(name) == nullptr) {
                samples_.header.entries.emplace_back(name, exact_text(scalar->array.at(0)));
            }
        }
    }

    void add_text(const std::string& key, const nlohmann::ordered_json& value) {
        if (value.is_string()) {
            samples_.header.entries.emplace_back(key, value.get<std::string>());
        } else if (!value.is_structured()) {
            samples_.header.entries.emplace_back(key, value.is_null() ? "" : value.dump());
        }
    }

    /// The Python package writes a radius for each sample, also where all are half the distance.
    void drop_equal_radii() {
        const std::string* const text = samples_.header.find("min_distance");
        const double distance = text == nullptr ? 0 : parse_real(*text).value_or(0);
        const auto is_half = [distance](const SampleRow& row) {
            return row.radius == distance / 2;
        };
        if (std::ranges::all_of(samples_.rows, is_half)) {
            for (SampleRow& row : samples_.rows) {
                row.radius = 0;
            }
        }
    }

    std::optional<std::size_t> place_of(std::string_view name) const {
        const auto found = std::ranges::find(columns_, name, &Column::name);
        return found == columns_.end()
                   ? std::nullopt
                   : std::optional(static_cast<std::size_t>(found - columns_.begin()));
    }

    const Path& path_;
    SampleDomain domain_;
    const std::string& numbers_;
    std::vector<NamedArray> arrays_;
    std::vector<Column> columns_;
    std::size_t rows_ = 0;
    SampleFile samples_;
};

} // namespace

bool is_of_numpy(std::string_view bytes) {
    return bytes.starts_with(kZip) || bytes.starts_with(kEmptyZip) || bytes.starts_with(kNpy);
}

SampleFile read_numpy_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                              const std::string& numbers) {
    std::vector<ZipMember> members;
    std::vector<NamedArray> arrays;
    if (bytes.starts_with(kNpy)) {
        arrays.push_back({"", NumpyArray(path, "", bytes)});
    } else {
        members = read_zip(path, bytes);
    }
    constexpr std::string_view kSuffix = ".npy";
    for (const auto& [name, content] : members) {
        if (name.ends_with(kSuffix)) {
            const std::string array = name.substr(0, name.size() - kSuffix.size());
            arrays.push_back({array, NumpyArray(path, array, content)});
        }
    }
    if (arrays.empty()) {
        fail_input(path, "is a ZIP archive without arrays of numpy; unpack it first");
    }
    return NumpyReader(path, domain, numbers).read(std::move(arrays));
}

} // namespace geodisk::tools
