// Samples in PCD files, of geodisk or other programs.
#include <algorithm>

#include "files/byte_order.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

struct Field {
    std::string name;
    std::size_t size = 4, count = 1, offset = 0; ///< In bytes; the offset in values for text.
    char type = 'F';
};

class PcdReader {
  public:
    PcdReader(const Path& path, std::string_view bytes, SampleDomain domain,
              const std::string& numbers)
        : path_(path), bytes_(bytes), domain_(domain), numbers_(numbers), lines_(bytes) {}

    SampleFile read() {
        read_header();
        const ColumnPlaces places =
            find_places(path_, domain_, [this](std::string_view name) { return place_of(name); });
        extra_.emplace(
            path_, [this](std::string_view name) { return place_of(name); }, numbers_);
        samples_.dimension = places.dimension();
        samples_.has_faces = places.has_faces;
        if (data_ == "ascii") {
            read_text(places);
        } else if (data_ == "binary") {
            read_binary(places);
        } else {
            fail("data of the kind " + in_quotes(data_) + " is not read; write ascii or binary");
        }
        move_origin();
        std::move(*extra_).move_to(samples_);
        return std::move(samples_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { fail_input(path_, message); }

    void read_header() {
        std::vector<std::string_view> words;
        for (std::string_view line; data_.empty();) {
            if (!lines_.next(line)) {
                fail("the file ends inside the header, before DATA");
            }
            if (line.starts_with('#')) {
                add_entry(samples_.header, trimmed(line.substr(1)));
                continue;
            }
            split_tokens(line, words);
            if (!words.empty()) {
                take_line(words);
            }
        }
        if (!points_ || fields_.empty()) {
            fail("its header lacks POINTS or FIELDS");
        }
        const bool is_text = data_ == "ascii";
        for (Field& field : fields_) {
            field.offset = record_;
            record_ += is_text ? field.count : field.count * field.size;
        }
    }

    void take_line(const std::vector<std::string_view>& words) {
        const std::string_view key = words[0];
        const std::size_t values = words.size() - 1;
        if (key == "FIELDS") {
            fields_.assign(values, {});
        }
        const bool is_of_fields =
            key == "FIELDS" || key == "SIZE" || key == "TYPE" || key == "COUNT";
        if (is_of_fields && values != fields_.size()) {
            fail("its header has " + std::to_string(values) + " values of " + std::string(key) +
                 " for " + std::to_string(fields_.size()) + " fields");
        }
        for (std::size_t i = 0; i < values && is_of_fields; ++i) {
            set(fields_[i], key, words[i + 1]);
        }
        if ((key == "POINTS" || key == "DATA") && values != 1) {
            fail("its header has a line " + std::string(key) + " of " + std::to_string(values) +
                 " values");
        }
        if (key == "POINTS") {
            points_ = number(words[1]);
        } else if (key == "DATA") {
            data_ = words[1];
        }
    }

    void set(Field& field, std::string_view key, std::string_view value) const {
        if (key == "FIELDS") {
            const bool is_normal = value.starts_with("normal_") && value.size() == 8;
            field.name = is_normal ? std::string("n") + value[7] : std::string(value);
        } else if (key == "TYPE") {
            field.type = value[0];
        } else {
            constexpr std::size_t kMax = 1 << 16;
            const std::size_t count = number(value);
            if (count == 0 || count > kMax) {
                fail("its header has the " + std::string(key) + ' ' + in_quotes(value));
            }
            (key == "SIZE" ? field.size : field.count) = count;
        }
    }

    std::size_t number(std::string_view text) const {
        const auto value = parse_integer<std::size_t>(text);
        if (!value) {
            fail("its header has " + in_quotes(text) + " for a number");
        }
        return *value;
    }

    std::optional<std::size_t> place_of(std::string_view name) const {
        const auto found = std::ranges::find(fields_, name, &Field::name);
        return found == fields_.end()
                   ? std::nullopt
                   : std::optional(static_cast<std::size_t>(found - fields_.begin()));
    }

    void read_text(const ColumnPlaces& places) {
        std::vector<std::string_view> words;
        for (std::string_view line; lines_.next(line);) {
            split_tokens(line, words);
            if (words.empty()) {
                continue;
            }
            const auto fail_line = [this](const std::string& message) {
                fail("line " + std::to_string(lines_.number()) + ": " + message);
            };
            if (words.size() != record_) {
                fail_line("has " + std::to_string(words.size()) + " values instead of " +
                          std::to_string(record_));
            }
            add_row(
                places,
                [&](std::size_t place) {
                    const std::string_view word = words[fields_[place].offset];
                    const auto value = parse_real(word);
                    if (!value) {
                        fail_line(in_quotes(word) + " is not a number");
                    }
                    return *value;
                },
                fail_line);
        }
        check_last_line(path_, bytes_);
        if (samples_.rows.size() != *points_) {
            fail_count(samples_.rows.size());
        }
    }

    void read_binary(const ColumnPlaces& places) {
        const std::string_view data = bytes_.substr(lines_.position());
        if (data.size() / record_ < *points_) {
            fail_count(data.size() / record_);
        }
        for (std::size_t i = 0; i < *points_; ++i) {
            add_row(
                places,
                [&](std::size_t place) {
                    return binary_value(fields_[place],
                                        data.data() + i * record_ + fields_[place].offset);
                },
                [&](const std::string& message) {
                    fail("point " + std::to_string(i) + ": " + message);
                });
        }
    }

    double binary_value(const Field& field, const char* bytes) const {
        constexpr std::size_t kMax = sizeof(double);
        switch (field.size > kMax ? 0 : field.type * 16 + static_cast<int>(field.size)) {
        case 'F' * 16 + 4:
            return number_of_bytes<float>(bytes);
        case 'F' * 16 + 8:
            return number_of_bytes<double>(bytes);
        case 'U' * 16 + 1:
            return number_of_bytes<std::uint8_t>(bytes);
        case 'U' * 16 + 2:
            return number_of_bytes<std::uint16_t>(bytes);
        case 'U' * 16 + 4:
            return number_of_bytes<std::uint32_t>(bytes);
        case 'I' * 16 + 1:
            return number_of_bytes<std::int8_t>(bytes);
        case 'I' * 16 + 2:
            return number_of_bytes<std::int16_t>(bytes);
        case 'I' * 16 + 4:
            return number_of_bytes<std::int32_t>(bytes);
        default:
            fail("field " + in_quotes(field.name) + " is of type " + std::string(1, field.type) +
                 " and size " + std::to_string(field.size) + ", which is not read");
        }
    }

    template <class ValueAt, class Fail>
    void add_row(const ColumnPlaces& places, const ValueAt& value_at, const Fail& fail) {
        samples_.rows.push_back(make_row(places, value_at, fail));
        extra_->add_row([&](std::size_t place) { return std::optional(value_at(place)); });
    }

    [[noreturn]] void fail_count(std::size_t found) const {
        fail("has " + counted(found, "point", "points") + ", but its header says " +
             grouped(*points_) + "; the file may be cut short");
    }

    /// geodisk writes x y z relative to a point where floats would blur them.
    void move_origin() {
        const std::string* const text = samples_.header.find(kOrigin);
        if (text == nullptr) {
            return;
        }
        std::vector<std::string_view> words;
        split_tokens(*text, words);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto value = words.size() == 3 ? parse_real(words[axis]) : std::nullopt;
            if (!value || !std::isfinite(*value)) {
                fail("its header has the origin " + in_quotes(*text) +
                     ", which is not three numbers");
            }
            for (SampleRow& row : samples_.rows) {
                row.position[axis] += samples_.dimension == 3 ? *value : 0;
            }
        }
        std::erase_if(samples_.header.entries,
                      [](const auto& entry) { return entry.first == kOrigin; });
    }

    const Path& path_;
    std::string_view bytes_;
    SampleDomain domain_;
    const std::string& numbers_;
    TextLines lines_;
    SampleFile samples_;
    std::optional<ExtraReader> extra_;
    std::vector<Field> fields_;
    std::optional<std::size_t> points_;
    std::string data_;       ///< The kind, "" before it is known.
    std::size_t record_ = 0; ///< Bytes of a point, or values in text.
};

} // namespace

SampleFile read_pcd_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers) {
    return PcdReader(path, bytes, domain, numbers).read();
}

} // namespace geodisk::tools
