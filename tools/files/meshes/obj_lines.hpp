// The lines of an OBJ file, for its reader and for whoever looks for names of files in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "files/text_lines.hpp"

namespace geodisk::tools {

/// Steps through lines without comments, each joined with those that continue it.
class ObjLines {
  public:
    explicit ObjLines(std::string_view text, ReadingProgress progress = {})
        : lines_(text, std::move(progress)) {}

    /// Gives the next line, which stays valid until the next call; false at the end of the text.
    bool next(std::string_view& line) {
        if (!lines_.next(line)) {
            return false;
        }
        number_ = lines_.number();
        bool continues = take_comment(line);
        if (!continues) {
            return true;
        }
        joined_ = line;
        std::string_view more;
        while (continues && lines_.next(more)) {
            continues = take_comment(more);
            joined_ += more;
        }
        line = joined_;
        return true;
    }

    /// Number of the line that next() gave last, from 1; the first one of those joined.
    std::uint32_t number() const noexcept { return number_; }

    /// As TextLines::nul_message().
    std::string nul_message() const { return lines_.nul_message(); }

  private:
    /// Takes off a comment, or the backslash of a line that goes on: then true.
    static bool take_comment(std::string_view& line) {
        if (const std::string_view bare = without_comment(line); bare.size() < line.size()) {
            line = bare;
            return false;
        }
        const bool continues = line.ends_with('\\');
        line.remove_suffix(continues ? 1 : 0);
        return continues;
    }

    TextLines lines_;
    std::string joined_; ///< A line that is continued.
    std::uint32_t number_ = 0;
};

} // namespace geodisk::tools
