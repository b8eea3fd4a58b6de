// Names of files as the user writes them.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

namespace geodisk::tools {

/// A path made from UTF-8, whatever the code page and the C library say of plain characters.
class Path : public std::filesystem::path {
  public:
    Path() = default;
    Path(std::filesystem::path other) : std::filesystem::path(std::move(other)) {}
    Path(const std::string& utf8)
        : std::filesystem::path(std::u8string(utf8.begin(), utf8.end())) {}
    Path(const char* utf8) : Path(std::string(utf8)) {}
};

} // namespace geodisk::tools
