// Files of XML. An entity that a file defines is not expanded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "program/path.hpp"

namespace geodisk::tools {

class XmlFile {
  public:
    /// Parses `text`, of the file `path`; both must outlive it. Throws UserError(bad_input), like
    /// all members, with the line.
    XmlFile(const Path& path, std::string_view text);

    const Path& path() const noexcept { return path_; }
    /// Returns the outermost element.
    pugi::xml_node root() const { return document_.document_element(); }

    /// Returns the number in an attribute; nothing if the element has no such attribute.
    std::optional<std::uint64_t> count_in(const pugi::xml_node& node, const char* attribute) const;

    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const;

  private:
    [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

    const Path& path_;
    std::string_view text_;
    pugi::xml_document document_;
};

} // namespace geodisk::tools
