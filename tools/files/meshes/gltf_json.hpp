// The JSON of a glTF file: read with all that may be odd about it, and its values with messages
// that name them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "program/path.hpp"

namespace geodisk::tools {

using GltfJson = nlohmann::json;

/// Makes `text` of glTF the JSON that a parser reads: it may hold NaN, Infinity and bytes that are
/// not UTF-8, as some programs write them into what nobody reads here. Throws UserError(bad_input)
/// if it is nested deeply.
void clean_json(const Path& path, std::string& text);

/// The top-level document, and objects in it. Everything here throws UserError(bad_input) that
/// names the file and the value.
class GltfDocument {
  public:
    /// Parses `text` after clean_json(); it must be glTF 2.
    GltfDocument(const Path& path, std::string text);

    const Path& path() const noexcept { return path_; }
    [[noreturn]] void fail(const std::string& message) const;

    const GltfJson& root() const noexcept { return root_; }

    /// Number of elements of the top-level array `list`, 0 if there is none.
    std::size_t count(const char* list) const;
    /// Element `index` of the top-level array `list`; messages call it by `name`, as "node 7".
    const GltfJson& at(const char* list, const char* name, std::uint64_t index) const;

    /// The object `name` in `parent`, or null. `where` names the parent in messages, as below.
    const GltfJson* find_object(const GltfJson& parent, const char* name,
                                const std::string& where) const;
    /// The object `name` in the `extensions` of `parent`, or null.
    const GltfJson* find_extension(const GltfJson& parent, const char* name,
                                   const std::string& where) const;
    /// The array `name` in `parent`; empty if there is none.
    const GltfJson& array(const GltfJson& parent, const char* name, const std::string& where) const;

    std::optional<std::uint64_t> find_index(const GltfJson& parent, const char* name,
                                            const std::string& where) const;
    std::uint64_t index(const GltfJson& parent, const char* name, const std::string& where) const;
    std::uint64_t index_or(const GltfJson& parent, const char* name, std::uint64_t otherwise,
                           const std::string& where) const;
    /// The array of indices `name`.
    std::vector<std::uint64_t> indices(const GltfJson& parent, const char* name,
                                       const std::string& where) const;
    /// The array of numbers `name`: `size` of them, or any number of them for 0. Empty if there is
    /// none.
    std::vector<double> numbers(const GltfJson& parent, const char* name, std::size_t size,
                                const std::string& where) const;
    /// A single number, which must be finite.
    double number_or(const GltfJson& parent, const char* name, double otherwise,
                     const std::string& where) const;
    /// Text, or "".
    std::string text(const GltfJson& parent, const char* name, const std::string& where) const;
    bool flag(const GltfJson& parent, const char* name, const std::string& where) const;

  private:
    const GltfJson* find(const GltfJson& parent, const char* name) const;
    [[noreturn]] void fail_value(const char* name, const std::string& where,
                                 const char* expected) const;
    std::uint64_t to_index(const GltfJson& value, const char* name, const std::string& where) const;
    void check_version() const;
    /// Returns the version that the asset states, or "". Some files have the number 1 instead of
    /// "1.0".
    std::string version_of(const GltfJson& asset) const;

    Path path_;
    GltfJson root_;
};

} // namespace geodisk::tools
