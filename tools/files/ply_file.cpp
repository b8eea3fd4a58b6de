#include "files/ply_file.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "files/byte_order.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

struct TypeInfo {
    std::string_view name, other_name;
    std::size_t size;
    void (*numbers)(const char* bytes, bool is_little, std::span<double> out);
};

/// By PlyType.
constexpr std::array<TypeInfo, 8> kTypes{{
    {"char", "int8", 1, numbers_of_bytes<std::int8_t>},
    {"uchar", "uint8", 1, numbers_of_bytes<std::uint8_t>},
    {"short", "int16", 2, numbers_of_bytes<std::int16_t>},
    {"ushort", "uint16", 2, numbers_of_bytes<std::uint16_t>},
    {"int", "int32", 4, numbers_of_bytes<std::int32_t>},
    {"uint", "uint32", 4, numbers_of_bytes<std::uint32_t>},
    {"float", "float32", 4, numbers_of_bytes<float>},
    {"double", "float64", 8, numbers_of_bytes<double>},
}};

const TypeInfo& info_of(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)];
}

/// A list count must be a whole number that the rest of the file can hold.
std::optional<std::size_t> list_size(double count, std::size_t largest) {
    if (!(count >= 0 && count <= static_cast<double>(largest))) {
        return std::nullopt;
    }
    const std::size_t size = static_cast<std::size_t>(count);
    return static_cast<double>(size) == count ? std::optional(size) : std::nullopt;
}

std::optional<std::size_t> find_property(const PlyElement& element, std::string_view name,
                                         bool is_list) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.name != name || property.count_type.has_value() != is_list) {
            continue;
        }
        if (found) {
            fail_input(element.file, "line " + std::to_string(property.line) + ": property " +
                                         in_quotes(name) + " is declared twice");
        }
        found = i;
    }
    return found;
}

} // namespace

std::optional<std::size_t> PlyElement::find_scalar(std::string_view wanted) const {
    return find_property(*this, wanted, false);
}

std::optional<std::size_t> PlyElement::find_list(std::string_view wanted) const {
    return find_property(*this, wanted, true);
}

std::size_t size_of(PlyType type) {
    return info_of(type).size;
}

double value_of(PlyType type, const char* bytes, bool is_little_endian) {
    double value = 0;
    info_of(type).numbers(bytes, is_little_endian, {&value, 1});
    return value;
}

PlyFile::PlyFile(const Path& path, ReadingProgress progress)
    : PlyFile(path, read_text(path), std::move(progress)) {}

PlyFile::PlyFile(const Path& path, std::string bytes, ReadingProgress progress)
    : path_(path), progress_(std::move(progress)), bytes_(std::move(bytes)) {
    parse_header();
}

void PlyFile::fail_header(const std::string& message) const {
    fail_input(path_, "line " + std::to_string(line_) + ": " + message);
}

void PlyFile::fail(const PlyElement& element, std::uint64_t record,
                   const std::string& message) const {
    fail_input(path_,
               "element " + element.name + ", record " + std::to_string(record) + ": " + message);
}

std::string_view PlyFile::next_line() {
    const std::size_t end = std::min(bytes_.find(line_end_, position_), bytes_.size());
    std::string_view line(bytes_.data() + position_, end - position_);
    position_ = std::min(end + 1, bytes_.size());
    ++line_;
    if (line.ends_with('\r')) {
        line.remove_suffix(1);
    }
    return line;
}

void PlyFile::parse_header() {
    if (bytes_.empty()) {
        fail_input(path_, "is empty");
    }
    const std::size_t first_end = bytes_.find_first_of("\r\n");
    if (first_end != std::string::npos && bytes_.compare(first_end, 2, "\r\n") != 0) {
        line_end_ = bytes_[first_end];
    }
    position_ = text_begin(bytes_);
    if (trimmed(next_line()) != "ply") {
        refuse_other_mesh(path_, bytes_, ".ply");
        fail_input(path_, "is not a PLY file: it does not begin with a line 'ply'");
    }
    bool more = true;
    while (more) {
        const std::string_view line = next_line();
        if (position_ == bytes_.size() && trimmed(line) != "end_header") {
            fail_header("the file ends inside the header, before end_header");
        }
        more = parse_header_line(line);
    }
    if (!format_) {
        fail_input(path_, "the header has no format record");
    }
}

bool PlyFile::parse_header_line(std::string_view line) {
    std::vector<std::string_view> tokens;
    split_tokens(line, tokens);
    const std::string_view keyword = tokens.empty() ? std::string_view() : tokens[0];
    if (keyword == "end_header") {
        return false;
    }
    if (keyword == "comment") {
        comments_.emplace_back(trimmed(trimmed(line).substr(keyword.size())));
    } else if (keyword == "format") {
        parse_format(tokens);
    } else if (keyword == "element") {
        parse_element(tokens);
    } else if (keyword == "property") {
        parse_property(tokens);
    } else if (!keyword.empty() && keyword != "obj_info") {
        unknown_lines_.add(line_);
    }
    return true;
}

void PlyFile::parse_format(const std::vector<std::string_view>& tokens) {
    if (tokens.size() != 3 || tokens[2] != "1.0" || format_) {
        fail_header("the header needs one record 'format FORMAT 1.0'");
    }
    if (tokens[1] == "ascii") {
        format_ = Format::ascii;
    } else if (tokens[1] == "binary_little_endian") {
        format_ = Format::little_endian;
    } else if (tokens[1] == "binary_big_endian") {
        format_ = Format::big_endian;
    } else {
        fail_header("unknown format " + in_quotes(tokens[1]));
    }
}

void PlyFile::count_declaration() {
    constexpr std::size_t kMax = 10'000; // Files have some ten.
    if (++declarations_ > kMax) {
        fail_header("more than 10,000 elements and properties");
    }
}

void PlyFile::parse_element(const std::vector<std::string_view>& tokens) {
    if (tokens.size() != 3) {
        fail_header("an element record reads 'element NAME COUNT'");
    }
    const std::optional<std::uint64_t> count = parse_integer<std::uint64_t>(tokens[2]);
    if (!count) {
        fail_header(in_quotes(tokens[2]) + " is not an element count");
    }
    count_declaration();
    elements_.push_back({path_, std::string(tokens[1]), *count, {}});
}

void PlyFile::parse_property(const std::vector<std::string_view>& tokens) {
    const auto type_named = [this](std::string_view name) {
        for (std::size_t i = 0; i < kTypes.size(); ++i) {
            if (name == kTypes[i].name || name == kTypes[i].other_name) {
                return PlyType{static_cast<std::uint8_t>(i)};
            }
        }
        fail_header("unknown property type " + in_quotes(name));
    };
    if (elements_.empty()) {
        fail_header("a property comes before any element");
    }
    const bool is_list = tokens.size() > 1 && tokens[1] == "list";
    if (tokens.size() != (is_list ? 5u : 3u)) {
        fail_header("a property record reads 'property TYPE NAME' or "
                    "'property list COUNT_TYPE TYPE NAME'");
    }
    count_declaration();
    PlyProperty property{std::string(tokens.back()), type_named(tokens[tokens.size() - 2]), {}, 0};
    property.line = static_cast<std::uint32_t>(line_);
    if (is_list) {
        property.count_type = type_named(tokens[2]);
        if (*property.count_type >= PlyType::float32) {
            fail_header("a list count must be an integer, not " + in_quotes(tokens[2]));
        }
    }
    elements_.back().properties.push_back(std::move(property));
}

void PlyFile::check_unique(const PlyElement& element) const {
    const auto count = std::count_if(elements_.begin(), elements_.end(),
                                     [&](const auto& other) { return other.name == element.name; });
    if (count > 1) {
        fail_input(path_, "element " + element.name + " is declared twice");
    }
}

void PlyFile::read_records(const PlyElement& element, const Visitor& visit) {
    if (element.properties.empty()) {
        return; // Without values a record takes no bytes; the count could be anything.
    }
    PlyRecord record;
    record.scalars.resize(element.properties.size());
    record.lists.resize(element.properties.size());
    for (std::uint64_t index = 0; index < element.count; ++index) {
        if (format_ == Format::ascii) {
            read_ascii_record(element, index, record);
        } else {
            read_binary_record(element, index, record);
        }
        visit(index, record);
        tell(progress_, index, position_, bytes_.size());
    }
}

void PlyFile::read_ascii_record(const PlyElement& element, std::uint64_t index, PlyRecord& record) {
    tokens_.clear();
    if (!append_line()) {
        fail(element, index, "the file ends inside element " + element.name);
    }
    std::size_t next = 0;
    const std::size_t on_line = tokens_.size();
    const auto read_value = [&] {
        if (next == tokens_.size() && !append_line()) {
            fail(element, index, "the line has too few values");
        }
        const std::string_view token = tokens_[next++];
        const std::optional<double> value = parse_real(token);
        if (!value) {
            fail(element, index, in_quotes(token) + " is not a number");
        }
        return *value;
    };
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const double value = read_value();
        if (!element.properties[i].count_type) {
            record.scalars[i] = value;
            continue;
        }
        const std::optional<std::size_t> size =
            list_size(value, tokens_.size() - next + (bytes_.size() - position_ + 1) / 2);
        if (!size) {
            fail(element, index,
                 "the line has no room for a list of " + in_quotes(tokens_[next - 1]) + " values");
        }
        record.lists[i].resize(*size);
        std::generate(record.lists[i].begin(), record.lists[i].end(), read_value);
    }
    if (next != tokens_.size()) {
        if (tokens_.size() > on_line) {
            fail(element, index, "the line has too few values");
        }
        ++surplus_lines_;
    }
}

bool PlyFile::append_line() {
    const std::size_t before = tokens_.size();
    while (tokens_.size() == before && position_ < bytes_.size()) {
        append_tokens(next_line(), tokens_);
    }
    return tokens_.size() > before;
}

bool PlyFile::read_binary_values(PlyType type, std::span<double> values) {
    const TypeInfo& info = info_of(type);
    if ((bytes_.size() - position_) / info.size < values.size()) {
        return false;
    }
    info.numbers(bytes_.data() + position_, format_ == Format::little_endian, values);
    position_ += values.size() * info.size;
    return true;
}

void PlyFile::read_binary_record(const PlyElement& element, std::uint64_t index,
                                 PlyRecord& record) {
    const auto read_values = [&](PlyType type, std::span<double> values) {
        if (!read_binary_values(type, values)) {
            fail(element, index, "the file ends inside element " + element.name);
        }
    };
    const std::vector<PlyProperty>& properties = element.properties;
    for (std::size_t i = 0, end = 0; i < properties.size(); i = end) {
        const PlyProperty& property = properties[i];
        end = i + 1;
        if (!property.count_type) {
            while (end < properties.size() && properties[end].type == property.type &&
                   !properties[end].count_type) {
                ++end;
            }
            read_values(property.type, std::span(record.scalars).subspan(i, end - i));
            continue;
        }
        double count = 0;
        read_values(*property.count_type, {&count, 1});
        const std::size_t room = (bytes_.size() - position_) / info_of(property.type).size;
        const std::optional<std::size_t> size = list_size(count, room);
        if (!size) {
            fail(element, index,
                 count < 0 ? "a list has a negative count"
                           : "the file ends inside element " + element.name);
        }
        record.lists[i].resize(*size);
        read_values(property.type, record.lists[i]);
    }
}

std::size_t PlyFile::possible_records(const PlyElement& element) const {
    std::size_t smallest = 1;
    for (const PlyProperty& property : element.properties) {
        const std::size_t in_binary = info_of(property.count_type.value_or(property.type)).size;
        smallest += format_ == Format::ascii ? 1 : in_binary;
    }
    const std::size_t room = (bytes_.size() - position_) / std::max<std::size_t>(1, smallest - 1);
    return static_cast<std::size_t>(std::min<std::uint64_t>(element.count, room));
}

std::size_t PlyFile::trailing_bytes() const {
    const std::string_view rest(bytes_.data() + position_, bytes_.size() - position_);
    const bool is_blank =
        format_ == Format::ascii && rest.find_first_not_of(" \t\r\n") == std::string_view::npos;
    return is_blank ? 0 : rest.size();
}

} // namespace geodisk::tools
