// The data arrays of VTK's XML files: text, base64 or raw bytes behind the XML, compressed or not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "files/number_type.hpp"
#include "files/xml_file.hpp"

namespace geodisk::tools {

/// Cuts the bytes of the element AppendedData, which are no XML, out of a file.
struct VtpParts {
    std::string xml;           ///< All before them, with its elements ended.
    std::string_view appended; ///< What is behind their mark '_'.

    explicit VtpParts(std::string_view bytes);
};

/// Throws UserError(bad_input) unless a file has points and faces of VTK.
void check_polydata(const XmlFile& file);

/// Reads arrays. Throws UserError(bad_input) with the line of the array.
class VtpData {
  public:
    /// Both must outlive it.
    VtpData(const XmlFile& file, std::string_view appended);

    /// Returns the type of the numbers of an array, or null if it has none.
    static const NumberType* type_of(const pugi::xml_node& array);

    /// Returns the numbers of an array, which must be `count`. Arrays may not share bytes: together
    /// they could be far larger than the file.
    std::vector<double> read(const pugi::xml_node& array, std::uint64_t count);

  private:
    /// Where the bytes of an array are.
    struct Source {
        std::string_view text;
        bool is_base64;
    };

    Source source_of(const pugi::xml_node& array, std::string_view format) const;
    std::string first_bytes(const pugi::xml_node& array, const Source& source,
                            std::size_t count) const;
    std::uint64_t head_at(std::string_view head, std::size_t index) const;
    std::string all_bytes(const pugi::xml_node& array, const Source& source, std::size_t head,
                          std::size_t count);
    std::string plain_bytes(const pugi::xml_node& array, const Source& source, std::size_t count);
    std::string unpacked_bytes(const pugi::xml_node& array, const Source& source,
                               std::size_t count);

    const XmlFile& file_;
    std::string_view appended_;
    bool is_little_ = true, is_compressed_ = false, is_appended_base64_ = false;
    std::size_t taken_ = 0; ///< Appended bytes of the arrays so far.
    NumberType head_;       ///< Type of the counts before the bytes of an array.
};

} // namespace geodisk::tools
