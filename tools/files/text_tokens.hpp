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
        constexpr std::string_view kBlanks = " \t\r\n";
        const std::size_t begin =
            std::min(text_.find_first_not_of(kBlanks, position_), text_.size());
        position_ = std::min(text_.find_first_of(kBlanks, begin), text_.size());
        return text_.substr(begin, position_ - begin);
    }

    /// Returns where the last word ends.
    std::size_t position() const noexcept { return position_; }

  private:
    std::string_view text_;
    std::size_t position_;
};

} // namespace geodisk::tools
