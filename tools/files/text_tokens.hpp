// The words of a text that may go on over any number of lines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace geodisk::tools {

/// Steps through what is between blanks and line ends.
class TextTokens {
  public:
    explicit TextTokens(std::string_view text, std::size_t begin = 0)
        : text_(text), position_(begin) {}

    /// Returns the next word; an empty one at the end of the text.
    std::string_view next() {
        const auto is_blank = [](char c) {
            return c == ' ' || c == '\t' || c == '\r' || c == '\n';
        };
        const char* const end = text_.data() + text_.size();
        const char* const begin = std::find_if_not(text_.data() + position_, end, is_blank);
        const char* const behind = std::find_if(begin, end, is_blank);
        position_ = static_cast<std::size_t>(behind - text_.data());
        return {begin, static_cast<std::size_t>(behind - begin)};
    }

    /// Returns where the last word ends.
    std::size_t position() const noexcept { return position_; }

  private:
    std::string_view text_;
    std::size_t position_;
};

} // namespace geodisk::tools
