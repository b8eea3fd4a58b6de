#include "files/meshes/vtk_stream.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "files/input_file.hpp"
#include "files/text_file.hpp"
#include "files/text_tokens.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kVtkMagic = "# vtk DataFile Version ";
constexpr std::string_view kVtkMissing = " are expected, and the file ends before";

/// In binary files, numbers begin with their highest byte.
constexpr bool kVtkIsLittle = false;

constexpr std::array<std::pair<std::string_view, NumberType>, 21> kVtkTypes{{
    {"char", kNumberType<std::int8_t>},
    {"signed_char", kNumberType<std::int8_t>},
    {"unsigned_char", kNumberType<std::uint8_t>},
    {"short", kNumberType<std::int16_t>},
    {"unsigned_short", kNumberType<std::uint16_t>},
    {"int", kNumberType<std::int32_t>},
    {"unsigned_int", kNumberType<std::uint32_t>},
    {"long", kNumberType<std::int64_t>}, // As VTK writes it on Linux and macOS.
    {"unsigned_long", kNumberType<std::uint64_t>},
    {"float", kNumberType<float>},
    {"double", kNumberType<double>},
    {"vtkidtype", kNumberType<std::int32_t>}, // Whatever its size in memory.
    {"vtktypeint8", kNumberType<std::int8_t>},
    {"vtktypeuint8", kNumberType<std::uint8_t>},
    {"vtktypeint16", kNumberType<std::int16_t>},
    {"vtktypeuint16", kNumberType<std::uint16_t>},
    {"vtktypeint32", kNumberType<std::int32_t>},
    {"vtktypeuint32", kNumberType<std::uint32_t>},
    {"vtktypeint64", kNumberType<std::int64_t>},
    {"vtktypeuint64", kNumberType<std::uint64_t>},
    {"vtktypefloat64", kNumberType<double>},
}};

} // namespace

VtkStream::VtkStream(const Path& path, std::string_view bytes, const ReadingProgress& progress)
    : path_(path), bytes_(bytes), progress_(progress) {
    read_head();
}

void VtkStream::fail(const std::string& message) const {
    const auto lines =
        std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(place_), '\n');
    fail_input(path_, (is_binary_ ? "byte " + std::to_string(place_)
                                  : "line " + std::to_string(lines + 1)) +
                          ": " + message);
}

void VtkStream::read_head() {
    if (bytes_.empty()) {
        fail_input(path_, "is empty");
    }
    const std::string_view first = take_line();
    if (!first.starts_with(kVtkMagic)) {
        refuse_other_content(path_, bytes_);
        refuse_other_mesh(path_, bytes_, ".vtk");
        fail_input(path_, "is not a VTK file: it does not begin with '# vtk DataFile Version'");
    }
    std::string_view version = trimmed(first.substr(kVtkMagic.size()));
    version = version.substr(0, version.find('.'));
    version_ = parse_integer<int>(version).value_or(0);
    if (version_ < 1 || version_ > 5) {
        fail("version " + in_quotes(trimmed(first.substr(kVtkMagic.size()))) +
             " is none of 1.0 to 5.1, which are read");
    }
    take_line(); // A title.
    const std::string format = lower_case(std::string(trimmed(take_line())));
    if (format != "ascii" && format != "binary") {
        fail("ASCII or BINARY is expected");
    }
    is_binary_ = format == "binary";
}

std::string_view VtkStream::take_line() {
    place_ = position_;
    const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
    std::string_view line = bytes_.substr(position_, end - position_);
    position_ = std::min(end + 1, bytes_.size());
    if (line.ends_with('\r')) {
        line.remove_suffix(1);
    }
    return line;
}

bool VtkStream::next_line(std::vector<std::string_view>& words) {
    words.clear();
    while (words.empty() && position_ < bytes_.size()) {
        append_tokens(take_line(), words);
    }
    return !words.empty();
}

bool VtkStream::skip_block() {
    while (position_ < bytes_.size() && !trimmed(take_line()).empty()) {
    }
    return true;
}

VtkType VtkStream::type_named(std::string_view name) const {
    const std::string wanted = lower_case(std::string(name));
    if (wanted == "bit" || wanted == "string") {
        return {{}, wanted == "bit", wanted == "string"};
    }
    const auto found =
        std::ranges::find(kVtkTypes, wanted, &std::pair<std::string_view, NumberType>::first);
    if (found == kVtkTypes.end()) {
        fail("unknown type of numbers " + in_quotes(name));
    }
    return {found->second};
}

void VtkStream::check_product(std::uint64_t components, std::uint64_t rows) const {
    if (rows > 0 && components > std::numeric_limits<std::uint32_t>::max() / rows) {
        fail(grouped(rows) + " rows of " + counted(components, "number", "numbers") +
             std::string(kVtkMissing));
    }
}

void VtkStream::fail_at_end(std::uint64_t count) const {
    fail(counted(count, "number", "numbers") + std::string(kVtkMissing));
}

std::vector<double> VtkStream::values(const VtkType& type, std::uint64_t count) {
    if (type.is_text) {
        fail("text where numbers are expected");
    }
    return !is_binary_   ? text_values(count)
           : type.is_bit ? bit_values(count)
                         : binary_values(type.number, count);
}

std::vector<double> VtkStream::text_values(std::uint64_t count) {
    if (count > (bytes_.size() - position_ + 1) / 2) {
        fail_at_end(count);
    }
    std::vector<double> values;
    values.reserve(count);
    TextTokens words(bytes_, position_);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view word = words.next();
        if (word.empty()) {
            fail_at_end(count);
        }
        place_ = words.position() - word.size();
        const std::optional<double> value = parse_real(word);
        if (!value) {
            fail(in_quotes(word) + " is not a number");
        }
        values.push_back(*value);
        position_ = words.position();
        tell(progress_, i, position_, bytes_.size());
    }
    return values;
}

std::vector<double> VtkStream::binary_values(const NumberType& type, std::uint64_t count) {
    if (count > (bytes_.size() - position_) / type.size) {
        fail_at_end(count);
    }
    std::vector<double> values(count);
    for (double& value : values) {
        value = type.value(bytes_.data() + position_, kVtkIsLittle);
        position_ += type.size;
        tell(progress_, static_cast<std::uint64_t>(&value - values.data()), position_,
             bytes_.size());
    }
    return values;
}

std::vector<double> VtkStream::bit_values(std::uint64_t count) {
    if ((count + 7) / 8 > bytes_.size() - position_) {
        fail_at_end(count);
    }
    std::vector<double> values(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto byte = static_cast<unsigned char>(bytes_[position_ + i / 8]);
        values[i] = byte >> (7 - i % 8) & 1;
    }
    position_ += (count + 7) / 8;
    return values;
}

void VtkStream::skip(const VtkType& type, std::uint64_t components, std::uint64_t rows) {
    check_product(components, rows);
    const std::uint64_t count = components * rows;
    if (type.is_text) {
        skip_texts(count);
    } else {
        values(type, count);
    }
}

/// In text a line for each; in binary, the first two bits tell how many bytes hold the length.
void VtkStream::skip_texts(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
        if (position_ == bytes_.size()) {
            fail_at_end(count);
        }
        if (!is_binary_) {
            take_line();
            continue;
        }
        const unsigned kind = static_cast<unsigned char>(bytes_[position_]) >> 6u;
        const std::size_t size = std::size_t{1} << (3 - kind);
        std::uint64_t length = 0;
        for (std::size_t k = 0; k < size && position_ < bytes_.size(); ++k, ++position_) {
            const unsigned byte = static_cast<unsigned char>(bytes_[position_]);
            length = length << 8 | (k == 0 ? byte & 0x3fu : byte);
        }
        if (length > bytes_.size() - position_) {
            fail_at_end(count);
        }
        position_ += length;
    }
}

} // namespace geodisk::tools
