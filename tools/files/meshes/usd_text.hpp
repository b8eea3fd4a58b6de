// The text of USD (`.usda`): words, values and what stands in parentheses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// A value: its numbers and texts in order, whatever tuples and arrays they stand in.
struct UsdValue {
    std::vector<double> numbers;
    std::vector<std::string> texts; ///< Strings, tokens, paths and assets.
    std::uint32_t line = 0;
    bool is_array = false;
    bool is_blocked = false; ///< "None", which takes a value away.
};

/// A part of the text that has a meaning of its own.
struct UsdToken {
    enum class Kind : std::uint8_t { end, word, number, string, path, asset, sign };

    Kind kind = Kind::end;
    std::string_view text; ///< Without quotation marks and brackets.
    std::uint32_t line = 0;

    bool is_sign(char c) const { return kind == Kind::sign && text.front() == c; }
    bool is_word(std::string_view word) const { return kind == Kind::word && text == word; }
};

/// Steps through the text of a file. Throws UserError(bad_input) naming the line.
class UsdText {
  public:
    /// Both must outlive it.
    UsdText(const Path& path, std::string_view text);

    [[noreturn]] void fail(std::uint32_t line, const std::string& message) const;

    const UsdToken& peek() const { return token_; }
    UsdToken next();
    /// Takes the sign if it is next.
    bool take(char sign);
    /// Takes the sign, which must be next, after `what`.
    void expect(char sign, const std::string& what);

    /// Reads the value that is next, if it consists of numbers and texts.
    UsdValue value();
    /// Skips the value that is next, of any kind.
    void skip_value();
    /// Skips what is up to the bracket that closes the one that is next.
    void skip_brackets();

    /// Reads metadata in parentheses, if they are next. `entry(key)` may read the value of the key;
    /// otherwise it is skipped.
    using Entry = std::function<bool(const UsdToken& key)>;
    void metadata(const Entry& entry);

  private:
    void advance();
    void read_number();
    void read_string(char quote);
    void read_enclosed(UsdToken::Kind kind, std::string_view end);
    void skip_blanks();
    /// Skips one that may have several lines.
    void skip_comment();

    const Path& path_;
    std::string_view text_;
    std::size_t at_ = 0;
    std::uint32_t line_ = 1;
    UsdToken token_;
};

} // namespace geodisk::tools
