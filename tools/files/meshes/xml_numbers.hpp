// Arrays of numbers in the XML files of meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "files/number_type.hpp"
#include "files/xml_file.hpp"

namespace geodisk::tools {

/// Returns the numbers that `text`, of an element, has as words. Throws UserError(bad_input) unless
/// there are `count`.
std::vector<double> numbers_of_text(const XmlFile& file, const pugi::xml_node& node,
                                    std::string_view text, std::uint64_t count);

/// Returns the numbers that `bytes` hold.
std::vector<double> numbers_of_bytes(std::string_view bytes, const NumberType& type,
                                     bool is_little);

/// Returns the bytes of so many numbers. Throws UserError(bad_input) for more than memory has.
std::size_t bytes_of_numbers(const XmlFile& file, const pugi::xml_node& node,
                             const NumberType& type, std::uint64_t count);

} // namespace geodisk::tools
