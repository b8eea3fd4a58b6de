// "Did you mean": what a mistyped word may stand for.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// Returns "; did you mean NAME?" for the name of `known` that `word` is close to, else "". Close
/// is: begins with `word`, or turns into it by few edits for its length.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

/// Throws UserError(usage): "OPTION: 'WORD' is none of A, B and C", with the closest of them.
[[noreturn]] void fail_choice(const std::string& option, std::string_view word,
                              std::span<const std::string> known);

/// Throws this unless `word` is one of `known`.
void check_choice(const std::string& option, std::string_view word,
                  std::span<const std::string> known);

/// Returns "a, b and c", or what else is before the last word.
std::string listed(std::span<const std::string> words, std::string_view last = " and ");

} // namespace geodisk::tools
