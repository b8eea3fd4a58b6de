// The lines of a text, whatever ends them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "files/meshes/reading_progress.hpp"

namespace geodisk::tools {

/// Returns where `text` begins: behind its byte order mark, if it has one.
inline std::size_t text_begin(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    return text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
}

/// Returns `line` up to a comment, which '#' begins. Old C libraries of Windows write "1.#IND",
/// "1.#QNAN" and "1.#INF" for numbers that are not finite: that is no comment.
inline std::string_view without_comment(std::string_view line) {
    std::size_t at = line.find('#');
    while (at != std::string_view::npos && at + 1 < line.size() &&
           line.substr(0, at).ends_with("1.") &&
           std::string_view("IJQS").find(line[at + 1]) != std::string_view::npos) {
        at = line.find('#', at + 1);
    }
    return line.substr(0, at);
}

/// Steps through lines that end with LF, CR LF or CR. A byte order mark before the first is
/// skipped.
class TextLines {
  public:
    explicit TextLines(std::string_view text, ReadingProgress progress = {})
        : text_(text), progress_(std::move(progress)) {
        position_ = text_begin(text_);
        find_feed();
    }

    /// The next line without its end; false at the end of the text.
    bool next(std::string_view& line) {
        if (position_ == text_.size()) {
            return false;
        }
        begin_ = position_;
        // Only up to the next LF, which a text of CR alone has at its end.
        const std::string_view rest = text_.substr(position_, feed_ - position_);
        const std::size_t end = position_ + std::min(rest.find('\r'), rest.size());
        line = text_.substr(position_, end - position_);
        const bool is_crlf = end + 1 == feed_ && feed_ < text_.size();
        position_ = std::min(end + (is_crlf ? 2u : 1u), text_.size());
        if (position_ > feed_) {
            find_feed();
        }
        ++number_;
        tell(progress_, number_, position_, text_.size());
        return true;
    }

    /// Returns the number of the line that next() gave last, from 1.
    std::uint32_t number() const noexcept { return number_; }
    /// Returns where the next line begins.
    std::size_t position() const noexcept { return position_; }

    /// Tells that the line that next() gave last holds a NUL, and where in the text.
    std::string nul_message() const {
        return "contains a NUL byte at offset " + std::to_string(text_.find('\0', begin_)) +
               ", so this is not a text file";
    }

  private:
    void find_feed() { feed_ = std::min(text_.find('\n', position_), text_.size()); }

    std::string_view text_;
    ReadingProgress progress_;
    std::size_t begin_ = 0; ///< Start of the last line.
    std::size_t position_ = 0;
    std::size_t feed_ = 0; ///< The first LF from there on, or the end.
    std::uint32_t number_ = 0;
};

} // namespace geodisk::tools
