#include "files/meshes/usd_text.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Kind = UsdToken::Kind;

bool is_of_word(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 128 || std::isalnum(byte) != 0 || c == '_' || c == ':' || c == '.' || c == '!';
}

bool is_of_number(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-';
}

char closing(char c) {
    return c == '(' ? ')' : c == '[' ? ']' : c == '{' ? '}' : '\0';
}

std::string shown(const UsdToken& token) {
    constexpr std::size_t kMax = 40;
    return token.kind == Kind::end ? "the end of the file" : in_quotes(token.text.substr(0, kMax));
}

/// Returns a string without the backslashes that mark characters in it.
std::string without_marks(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        i += text[i] == '\\' && i + 1 < text.size() ? 1u : 0u;
        result += text[i];
    }
    return result;
}

} // namespace

UsdText::UsdText(const Path& path, std::string_view text)
    : path_(path), text_(text), at_(text_begin(text)) {
    advance();
}

void UsdText::fail(std::uint32_t line, const std::string& message) const {
    fail_input(path_, "line " + std::to_string(line) + ": " + message);
}

UsdToken UsdText::next() {
    UsdToken token = token_;
    advance();
    return token;
}

bool UsdText::take(char sign) {
    if (!token_.is_sign(sign)) {
        return false;
    }
    advance();
    return true;
}

void UsdText::expect(char sign, const std::string& what) {
    if (!take(sign)) {
        fail(token_.line,
             shown(token_) + " instead of '" + std::string(1, sign) + "' after " + what);
    }
}

void UsdText::skip_blanks() {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (c == '\n') {
            ++line_;
        } else if (c == '#' || text_.substr(at_, 2) == "//") {
            at_ = std::min(text_.find('\n', at_), text_.size());
            continue;
        } else if (text_.substr(at_, 2) == "/*") {
            skip_comment();
            continue;
        } else if (c != ' ' && c != '\t' && c != '\r' && c != ';' && c != ',') {
            return; // Commas only stand between what is known to follow anyway.
        }
        ++at_;
    }
}

void UsdText::skip_comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == text_.npos) {
        fail(line_, "the comment that begins here has no end");
    }
    line_ += static_cast<std::uint32_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                   text_.begin() + static_cast<std::ptrdiff_t>(end),
                                                   '\n'));
    at_ = end + 2;
}

void UsdText::advance() {
    skip_blanks();
    token_ = {Kind::end, {}, line_};
    if (at_ == text_.size()) {
        return;
    }
    const char c = text_[at_];
    const std::string_view rest = text_.substr(at_);
    const bool has_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (has_digit || c == '-' || c == '+' ||
        (c == '.' && rest.size() > 1 && is_of_number(rest[1]))) {
        read_number();
    } else if (c == '"' || c == '\'') {
        read_string(c);
    } else if (c == '<') {
        read_enclosed(Kind::path, ">");
    } else if (c == '@') {
        read_enclosed(Kind::asset, rest.starts_with("@@@") ? "@@@" : "@");
    } else if (is_of_word(c)) {
        const std::size_t begin = at_;
        at_ = static_cast<std::size_t>(
            std::find_if_not(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(),
                             is_of_word) -
            text_.begin());
        token_ = {Kind::word, text_.substr(begin, at_ - begin), line_};
    } else if (std::string_view("()[]{}=&?/*%$^~|>").find(c) != std::string_view::npos) {
        token_ = {Kind::sign, rest.substr(0, 1), line_};
        ++at_;
    } else {
        fail(line_, c == '\0' ? "contains a NUL byte, so this is not a text file"
                              : in_quotes(rest.substr(0, 1)) + " is unexpected");
    }
}

void UsdText::read_number() {
    const std::size_t begin = at_;
    at_ =
        static_cast<std::size_t>(std::find_if_not(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                  text_.end(), is_of_number) -
                                 text_.begin());
    token_ = {Kind::number, text_.substr(begin, at_ - begin), line_};
}

void UsdText::read_string(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_).starts_with(three);
    const std::string_view end =
        is_long ? std::string_view(three) : std::string_view(three).substr(2);
    const std::size_t begin = at_ + end.size();
    const std::uint32_t first_line = line_;
    for (at_ = begin; at_ < text_.size() && !text_.substr(at_).starts_with(end); ++at_) {
        at_ += text_[at_] == '\\' && at_ + 1 < text_.size() ? 1u : 0u;
        if (text_[at_] == '\n') {
            if (!is_long) {
                break;
            }
            ++line_;
        }
    }
    if (at_ >= text_.size() || !text_.substr(at_).starts_with(end)) {
        fail(first_line, "a string has no end");
    }
    token_ = {Kind::string, text_.substr(begin, at_ - begin), first_line};
    at_ += end.size();
}

void UsdText::read_enclosed(Kind kind, std::string_view end) {
    const std::size_t begin = at_ + end.size();
    const std::size_t found = text_.find(end, begin);
    if (found == std::string_view::npos ||
        text_.substr(begin, found - begin).find('\n') != std::string_view::npos) {
        fail(line_,
             (kind == Kind::path ? "a path" : "the name of a file") + std::string(" has no end"));
    }
    token_ = {kind, text_.substr(begin, found - begin), line_};
    at_ = found + end.size();
}

UsdValue UsdText::value() {
    UsdValue result;
    result.line = token_.line;
    result.is_array = token_.is_sign('[');
    std::string open; // Brackets to close.
    do {
        const UsdToken token = next();
        switch (token.kind) {
        case Kind::number: {
            const std::optional<double> number =
                parse_real(token.text.starts_with('+') ? token.text.substr(1) : token.text);
            if (!number) {
                fail(token.line, in_quotes(token.text) + " is not a number");
            }
            result.numbers.push_back(*number);
            break;
        }
        case Kind::string:
            result.texts.push_back(without_marks(token.text));
            break;
        case Kind::path:
        case Kind::asset:
            result.texts.emplace_back(token.text);
            break;
        case Kind::word:
            if (const auto number = parse_real(token.text)) { // "nan" and "inf".
                result.numbers.push_back(*number);
            } else if (token.text == "true" || token.text == "false") {
                result.numbers.push_back(token.text == "true" ? 1 : 0);
            } else if (token.text == "None") {
                result.is_blocked = open.empty();
            } else {
                fail(token.line, shown(token) + " is no value");
            }
            break;
        case Kind::sign:
            if (token.is_sign('(') || token.is_sign('[')) {
                constexpr std::size_t kMostBrackets = 8;
                open += closing(token.text.front());
                if (open.size() > kMostBrackets) {
                    fail(token.line, "values are nested too deeply");
                }
                break;
            }
            if (open.empty() || token.text.front() != open.back()) {
                fail(token.line, shown(token) + " is unexpected in a value");
            }
            open.pop_back();
            break;
        case Kind::end:
            fail(token.line, "the file ends within a value");
        }
    } while (!open.empty());
    return result;
}

void UsdText::skip_brackets() {
    const UsdToken first = next();
    for (std::string open(1, closing(first.text.front())); !open.empty();) {
        const UsdToken token = next();
        if (token.kind == Kind::end) {
            fail(first.line, "the bracket " + shown(first) + " is not closed");
        }
        if (token.kind != Kind::sign) {
            continue;
        }
        if (const char end = closing(token.text.front()); end != '\0') {
            open += end;
        } else if (token.text.front() == open.back()) {
            open.pop_back();
        } else if (token.is_sign(')') || token.is_sign(']') || token.is_sign('}')) {
            fail(token.line, "the bracket " + shown(token) + " closes none");
        }
    }
}

void UsdText::skip_value() {
    if (token_.kind == Kind::sign && closing(token_.text.front()) != '\0') {
        skip_brackets();
        return;
    }
    const UsdToken token = next();
    if (token.kind == Kind::end || token.kind == Kind::sign) {
        fail(token.line, shown(token) + " instead of a value");
    }
    if (token.kind == Kind::asset &&
        token_.kind == Kind::path) { // A reference to a prim of a file.
        next();
    }
    if ((token.kind == Kind::asset || token.kind == Kind::path) && token_.is_sign('(') &&
        token_.line == token.line) { // Where in time and at what speed that file is.
        skip_brackets();
    }
}

void UsdText::metadata(const Entry& entry) {
    if (!token_.is_sign('(')) {
        return;
    }
    const std::uint32_t line = next().line;
    while (!take(')')) {
        UsdToken key = next();
        if (key.kind == Kind::string) { // A comment.
            continue;
        }
        constexpr std::string_view kEdits[] = {"prepend", "append", "add", "delete", "reorder"};
        const bool is_edit = std::ranges::find(kEdits, key.text) != std::end(kEdits);
        if (is_edit && token_.kind == Kind::word) {
            const bool is_kept = key.text == "delete" || key.text == "reorder";
            key = next();
            key.text = is_kept ? std::string_view() : key.text;
        }
        if (key.kind == Kind::end) {
            fail(line, "the bracket '(' is not closed");
        }
        if (key.kind != Kind::word) {
            fail(key.line, shown(key) + " is unexpected in metadata");
        }
        expect('=', "a key of metadata");
        if (!entry(key)) {
            skip_value();
        }
    }
}

} // namespace geodisk::tools
