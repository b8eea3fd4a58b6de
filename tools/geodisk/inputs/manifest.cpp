#include "geodisk/inputs/manifest.hpp"

#include <string_view>
#include <utility>

#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Returns the words of `line`, between blanks and tabs. Those in single or double quotes belong
/// together, also within a word; a # where a word may begin ends the line. Throws UserError(usage)
/// for a quote without end.
std::vector<std::string> split_words(const std::string& line) {
    constexpr std::string_view kBlanks = " \t";
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string::npos;) {
        if (line[at] == '#') {
            break;
        }
        std::string word;
        while (at < line.size() && kBlanks.find(line[at]) == std::string_view::npos) {
            const char quote = line[at++];
            if (quote != '"' && quote != '\'') {
                word += quote;
                continue;
            }
            const std::size_t end = line.find(quote, at);
            if (end == std::string::npos) {
                fail_usage(std::string("a quote ") + quote + " has no end");
            }
            word.append(line, at, end - at);
            at = end + 1;
        }
        words.push_back(std::move(word));
    }
    return words;
}

} // namespace

std::vector<ManifestLine> read_manifest(const Path& path) {
    const std::string text = read_text(path);
    std::vector<ManifestLine> lines;
    TextLines rest(text);
    for (std::string_view line; rest.next(line);) {
        try {
            if (auto words = split_words(std::string(line)); !words.empty()) {
                lines.push_back({rest.number(), std::move(words)});
            }
        } catch (const UserError& error) {
            throw UserError(error.code(), line_text(path, rest.number()) + ": " + error.what());
        }
    }
    return lines;
}

std::string line_text(const Path& path, std::uint32_t number) {
    return path.string() + ": line " + std::to_string(number);
}

} // namespace geodisk::tools
