#include "files/archives/numpy_array.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "files/byte_order.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

struct NumberType {
    std::string_view code; ///< Kind and size.
    std::string_view name;
    double (*value)(const char* bytes, bool is_little);
};

constexpr NumberType kNumberTypes[] = {
    {"f8", "float64", number_of_bytes<double>},
    {"f4", "float32", number_of_bytes<float>},
    {"u8", "uint64", number_of_bytes<std::uint64_t>},
    {"i8", "int64", number_of_bytes<std::int64_t>},
    {"u4", "uint32", number_of_bytes<std::uint32_t>},
    {"i4", "int32", number_of_bytes<std::int32_t>},
    {"u2", "uint16", number_of_bytes<std::uint16_t>},
    {"i2", "int16", number_of_bytes<std::int16_t>},
    {"u1", "uint8", number_of_bytes<std::uint8_t>},
    {"i1", "int8", number_of_bytes<std::int8_t>},
    {"b1", "bool", number_of_bytes<std::uint8_t>},
};

/// Returns what stands behind "'KEY':" in the header, which is a dictionary of Python.
std::string_view value_behind(std::string_view header, std::string_view key) {
    const std::size_t begin = header.find(key);
    return begin == std::string_view::npos ? std::string_view()
                                           : trimmed(header.substr(begin + key.size()));
}

} // namespace

NumpyArray::NumpyArray(const Path& path, const std::string& name, std::string_view bytes)
    : path_(path), name_(name) {
    constexpr std::size_t kVersion = kMagic.size(), kLength = kVersion + 2;
    if (!bytes.starts_with(kMagic) || bytes.size() < kLength + sizeof(std::uint32_t)) {
        fail("is no array of numpy");
    }
    const bool is_first_version = bytes[kVersion] == 1;
    const std::size_t begin =
        kLength + (is_first_version ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
    const std::size_t size = is_first_version
                                 ? value_of_bytes<std::uint16_t>(bytes.data() + kLength)
                                 : value_of_bytes<std::uint32_t>(bytes.data() + kLength);
    if (size > bytes.size() - begin) {
        fail("ends within its header; the file may be cut short");
    }
    parse_header(bytes.substr(begin, size));
    content_ = bytes.substr(begin + size);
    if (item_ == 0) {
        return; // Objects of Python, or no characters.
    }
    std::size_t values = content_.size() / item_;
    for (const std::size_t length : shape_) {
        values = length == 0 ? std::numeric_limits<std::size_t>::max() : values / length;
    }
    if (values == 0) {
        fail("has fewer values than its shape says; the file may be cut short");
    }
}

double NumpyArray::at(std::size_t row, std::size_t column) const {
    if (value_ == nullptr) {
        return 0;
    }
    const std::size_t columns = shape_.size() < 2 ? 1 : shape_[1];
    const std::size_t index = is_by_columns_ ? column * shape_[0] + row : row * columns + column;
    return value_(content_.data() + index * item_, is_little_);
}

std::string NumpyArray::text() const {
    std::string text;
    if (kind_ != 'U' || !shape_.empty()) {
        return text;
    }
    constexpr std::uint32_t kFirstBeyond = 0x80; // ASCII.
    for (std::size_t at = 0; at < item_; at += sizeof(std::uint32_t)) {
        const auto character = value_of_bytes<std::uint32_t>(content_.data() + at, is_little_);
        if (character >= kFirstBeyond) {
            return {};
        }
        text += static_cast<char>(character);
    }
    return text;
}

std::string NumpyArray::description() const {
    std::string lengths;
    for (const std::size_t length : shape_) {
        lengths += (lengths.empty() ? "" : ", ") + std::to_string(length);
    }
    return type_ + " (" + lengths + (shape_.size() == 1 ? ",)" : ")");
}

void NumpyArray::parse_header(std::string_view header) {
    const std::string_view type = value_behind(header, "'descr':");
    if (!type.starts_with('\'') || type.find('\'', 1) == std::string_view::npos) {
        fail("has records instead of numbers; save plain arrays, such as points of shape (n, 3)");
    }
    parse_type(type.substr(1, type.find('\'', 1) - 1));
    is_by_columns_ = value_behind(header, "'fortran_order':").starts_with("True");
    std::string_view shape = value_behind(header, "'shape':");
    if (!shape.starts_with('(') || shape.find(')') == std::string_view::npos) {
        fail("has no shape; write it again");
    }
    shape = shape.substr(1, shape.find(')') - 1);
    while (!shape.empty()) {
        const std::size_t end = std::min(shape.find(','), shape.size());
        const auto length = parse_integer<std::size_t>(trimmed(shape.substr(0, end)));
        if (!length) {
            fail("has the shape (" + in_quotes(shape) + "), which is none; write it again");
        }
        shape_.push_back(*length);
        shape.remove_prefix(std::min(end + 1, shape.size()));
        shape = trimmed(shape);
    }
}

/// A byte order, a kind and a size: "<f8".
void NumpyArray::parse_type(std::string_view type) {
    type_ = one_line(type);
    is_little_ = !type.starts_with('>');
    const std::string_view code = type.substr(std::min<std::size_t>(type.size(), 1));
    const auto size =
        parse_integer<std::size_t>(code.substr(std::min<std::size_t>(code.size(), 1)));
    kind_ = code.empty() ? '\0' : code[0];
    item_ = size.value_or(0) * (kind_ == 'U' ? sizeof(std::uint32_t) : 1);
    for (const NumberType& known : kNumberTypes) {
        if (known.code == code) {
            type_ = known.name;
            value_ = known.value;
        }
    }
}

void NumpyArray::fail(const std::string& message) const {
    fail_input(path_, (name_.empty() ? "" : "array " + in_quotes(name_) + " ") + message);
}

} // namespace geodisk::tools
