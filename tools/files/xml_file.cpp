#include "files/xml_file.hpp"

#include <algorithm>

#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

XmlFile::XmlFile(const Path& path, std::string_view text)
    : path_(path), text_(text.substr(text_begin(text))) {
    if (text_.empty()) {
        fail_input(path_, "is empty");
    }
    if (text_[std::min(text_.find_first_not_of(" \t\r\n"), text_.size() - 1)] != '<') {
        refuse_other_content(path_, text_);
        refuse_other_mesh(path_, text_, "");
        fail_input(path_, "is no XML file: it does not begin with '<'");
    }
    const pugi::xml_parse_result result =
        document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
        fail_at(static_cast<std::size_t>(result.offset),
                std::string("is no whole XML: ") + result.description());
    }
}

void XmlFile::fail(const pugi::xml_node& node, const std::string& message) const {
    const char* const name = node.attribute("Name").value();
    fail_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)),
            "<" + std::string(node.name()) + "> " + (*name == '\0' ? "" : in_quotes(name) + " ") +
                message);
}

void XmlFile::fail_at(std::size_t offset, const std::string& message) const {
    const std::string_view before = text_.substr(0, offset);
    fail_input(path_, "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
                          ": " + message);
}

std::optional<std::uint64_t> XmlFile::count_in(const pugi::xml_node& node,
                                               const char* attribute) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) {
        return std::nullopt;
    }
    const auto count = parse_integer<std::uint64_t>(trimmed(found.value()));
    if (!count) {
        fail(node, std::string("has ") + attribute + "=" + in_quotes(found.value()) +
                       ", which is no number of elements");
    }
    return count;
}

} // namespace geodisk::tools
