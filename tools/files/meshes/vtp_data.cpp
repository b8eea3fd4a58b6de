#include "files/meshes/vtp_data.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "files/archives/inflate.hpp"
#include "files/base64.hpp"
#include "files/meshes/xml_numbers.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 10> kVtpTypes{{
    {"Int8", kNumberType<std::int8_t>},
    {"UInt8", kNumberType<std::uint8_t>},
    {"Int16", kNumberType<std::int16_t>},
    {"UInt16", kNumberType<std::uint16_t>},
    {"Int32", kNumberType<std::int32_t>},
    {"UInt32", kNumberType<std::uint32_t>},
    {"Int64", kNumberType<std::int64_t>},
    {"UInt64", kNumberType<std::uint64_t>},
    {"Float32", kNumberType<float>},
    {"Float64", kNumberType<double>},
}};

bool is_true_for_this_machine(std::string_view order) {
    return order.empty() ? std::endian::native == std::endian::little : order == "LittleEndian";
}

} // namespace

void check_polydata(const XmlFile& file) {
    const pugi::xml_node root = file.root();
    const std::string_view type = root.attribute("type").value();
    if (std::string_view(root.name()) != "VTKFile") {
        file.fail(root, "is not the VTKFile of a .vtp file");
    }
    if (type != "PolyData") {
        file.fail(root, "is of type " + in_quotes(type) +
                            "; only PolyData is read: extract the "
                            "surface first");
    }
}

VtpParts::VtpParts(std::string_view bytes) : xml(bytes) {
    const std::size_t element = bytes.find("<AppendedData");
    const std::size_t end = bytes.find('>', element == bytes.npos ? bytes.size() : element);
    if (end == bytes.npos) {
        return;
    }
    xml = std::string(bytes.substr(0, end + 1));
    if (!xml.ends_with("/>")) {
        xml += "</AppendedData>";
    }
    xml += "</VTKFile>";
    const std::size_t mark = bytes.find('_', end);
    appended = bytes.substr(mark == bytes.npos ? bytes.size() : mark + 1);
}

VtpData::VtpData(const XmlFile& file, std::string_view appended)
    : file_(file), appended_(appended) {
    const pugi::xml_node root = file.root();
    const auto value = [&](const char* name) {
        return std::string_view(root.attribute(name).value());
    };
    const std::string_view order = value("byte_order"), head = value("header_type"),
                           compressor = value("compressor");
    if (!order.empty() && order != "LittleEndian" && order != "BigEndian") {
        file.fail(root, "has the unknown byte_order " + in_quotes(order));
    }
    is_little_ = is_true_for_this_machine(order);
    if (!head.empty() && head != "UInt32" && head != "UInt64") {
        file.fail(root, "has the unknown header_type " + in_quotes(head));
    }
    head_ = head == "UInt64" ? kNumberType<std::uint64_t> : kNumberType<std::uint32_t>;
    is_compressed_ = !compressor.empty();
    if (is_compressed_ && compressor != "vtkZLibDataCompressor") {
        file.fail(root, "is compressed by " + in_quotes(compressor) +
                            ", which is not read; save it with zlib or uncompressed");
    }
    const std::string_view encoding = root.child("AppendedData").attribute("encoding").value();
    if (!encoding.empty() && encoding != "raw" && encoding != "base64") {
        file.fail(root, "has appended data in the unknown encoding " + in_quotes(encoding));
    }
    is_appended_base64_ = encoding == "base64";
}

const NumberType* VtpData::type_of(const pugi::xml_node& array) {
    const std::string_view name = array.attribute("type").value();
    const auto found =
        std::ranges::find(kVtpTypes, name, &std::pair<std::string_view, NumberType>::first);
    return found == kVtpTypes.end() ? nullptr : &found->second;
}

std::vector<double> VtpData::read(const pugi::xml_node& array, std::uint64_t count) {
    const NumberType* const type = type_of(array);
    if (type == nullptr) {
        file_.fail(array, "has the type " + in_quotes(array.attribute("type").value()) +
                              ", which is none of numbers");
    }
    const std::size_t size = bytes_of_numbers(file_, array, *type, count);
    const std::string_view format = array.attribute("format").value();
    if (format == "ascii" || format.empty()) {
        return numbers_of_text(file_, array, array.child_value(), count);
    }
    const Source source = source_of(array, format);
    if (size == 0) {
        return {};
    }
    return numbers_of_bytes(is_compressed_ ? unpacked_bytes(array, source, size)
                                           : plain_bytes(array, source, size),
                            *type, is_little_);
}

VtpData::Source VtpData::source_of(const pugi::xml_node& array, std::string_view format) const {
    if (format == "binary") {
        return {array.child_value(), true};
    }
    if (format != "appended") {
        file_.fail(array, "has the unknown format " + in_quotes(format));
    }
    const auto offset = file_.count_in(array, "offset");
    if (!offset || *offset >= appended_.size()) {
        file_.fail(array, offset ? "begins at byte " + grouped(*offset) + " of " +
                                       grouped(appended_.size()) + " that are appended"
                                 : "has no offset");
    }
    return {appended_.substr(*offset), is_appended_base64_};
}

std::string VtpData::first_bytes(const pugi::xml_node& array, const Source& source,
                                 std::size_t count) const {
    std::optional<std::string> bytes =
        source.is_base64 ? from_base64(source.text.substr(0, source.text.find('<')), count)
                         : std::optional(std::string(source.text.substr(0, count)));
    if (!bytes) {
        file_.fail(array, "is no base64");
    }
    if (bytes->size() < count) {
        file_.fail(array,
                   "ends after " + grouped(bytes->size()) + " of " + grouped(count) + " bytes");
    }
    return std::move(*bytes);
}

std::uint64_t VtpData::head_at(std::string_view head, std::size_t index) const {
    const char* const bytes = head.data() + index * head_.size;
    return head_.size == sizeof(std::uint64_t) ? value_of_bytes<std::uint64_t>(bytes, is_little_)
                                               : value_of_bytes<std::uint32_t>(bytes, is_little_);
}

/// Returns the bytes behind the head of an array.
std::string VtpData::all_bytes(const pugi::xml_node& array, const Source& source, std::size_t head,
                               std::size_t count) {
    std::string bytes = first_bytes(array, source, head + count);
    if (std::string_view(array.attribute("format").value()) == "appended") {
        taken_ += bytes.size();
        if (taken_ > appended_.size()) {
            file_.fail(array, "shares bytes with other arrays");
        }
    }
    bytes.erase(0, head);
    return bytes;
}

std::string VtpData::plain_bytes(const pugi::xml_node& array, const Source& source,
                                 std::size_t count) {
    const std::uint64_t size = head_at(first_bytes(array, source, head_.size), 0);
    if (size != count) {
        file_.fail(array, "has " + grouped(size) + " bytes, not " + grouped(count));
    }
    return all_bytes(array, source, head_.size, count);
}

/// Before the blocks, there are their number, the size of each, that of the last unless it is as
/// large, and the bytes that each takes.
std::string VtpData::unpacked_bytes(const pugi::xml_node& array, const Source& source,
                                    std::size_t count) {
    constexpr std::size_t kCounts = 3;
    const std::uint64_t blocks = head_at(first_bytes(array, source, head_.size), 0);
    if (blocks > source.text.size() / head_.size || blocks == 0) {
        file_.fail(array, "cannot have " + counted(blocks, "block", "blocks"));
    }
    const std::size_t head_size = (kCounts + blocks) * head_.size;
    const std::string head = first_bytes(array, source, head_size);
    const std::uint64_t full = head_at(head, 1), partial = head_at(head, 2);
    const std::uint64_t last = partial == 0 ? full : partial;
    if (last > count || (blocks > 1 && full > (count - last) / (blocks - 1)) ||
        (blocks > 1 ? (blocks - 1) * full : 0) + last != count) {
        file_.fail(array, "has blocks of " + grouped(full) + " and " + grouped(last) +
                              " bytes, which do not make " + grouped(count));
    }
    std::size_t size = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::uint64_t more = head_at(head, kCounts + i);
        if (more > source.text.size() - std::min(size, source.text.size())) {
            file_.fail(array, "ends before block " + std::to_string(i));
        }
        size += more;
    }
    const std::string packed = all_bytes(array, source, head_size, size);
    std::string bytes;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t length = head_at(head, kCounts + i);
        const auto block = inflated(file_.path(), std::string_view(packed).substr(begin, length),
                                    i + 1 < blocks ? full : last, Wrapping::zlib_or_gzip);
        if (!block) {
            file_.fail(array, "is damaged in block " + std::to_string(i));
        }
        bytes += *block;
        begin += length;
    }
    return bytes;
}

} // namespace geodisk::tools
