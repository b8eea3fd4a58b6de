#include "program/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kLongest = 64; // No name is as long, and long words take time to compare.

/// Returns what makes a difference to people: "--min_distance" is "min-distance".
std::string essence(std::string_view word) {
    std::string text(word.substr(std::min(word.find_first_not_of('-'), word.size())));
    for (char& c : text) {
        c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edits(std::string_view a, std::string_view b) {
    using Row = std::vector<std::size_t>;
    Row before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

} // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
    const std::string wanted = essence(word);
    if (wanted.size() < 2 || wanted.size() > kLongest) {
        return "";
    }
    const std::string* best = nullptr;
    std::size_t fewest = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    for (const std::string& name : known) {
        const std::string candidate = essence(name);
        const std::size_t distance = candidate.starts_with(wanted) ? 0 : edits(wanted, candidate);
        // Nothing would be left of a word of two letters.
        if (distance < fewest && distance + 1 < candidate.size()) {
            fewest = distance;
            best = &name;
        }
    }
    return best == nullptr ? "" : "; did you mean " + *best + "?";
}

void fail_choice(const std::string& option, std::string_view word,
                 std::span<const std::string> known) {
    const bool are_two = known.size() == 2;
    fail_usage(option + ": " + in_quotes(word) +
               (are_two ? " is neither " + known[0] + " nor " + known[1]
                        : " is none of " + listed(known)) +
               did_you_mean(word, known));
}

void check_choice(const std::string& option, std::string_view word,
                  std::span<const std::string> known) {
    if (std::ranges::find(known, word) == known.end()) {
        fail_choice(option, word, known);
    }
}

std::string listed(std::span<const std::string> words, std::string_view last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? last : ", ";
        text += words[i];
    }
    return text;
}

} // namespace geodisk::tools
