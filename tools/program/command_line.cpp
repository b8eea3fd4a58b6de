#include "program/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// "-x" and "--name", not "-", "-1" and "-.5".
bool looks_like_option(std::string_view word) {
    return word.size() > 1 && word[0] == '-' &&
           (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

class Sorter {
  public:
    Sorter(const CommandFacts& command, std::span<const std::string> words)
        : command_(command), words_(words) {}

    CommandLine sort() {
        while (at_ < words_.size()) {
            const std::string& word = words_[at_++];
            if (word == "--") {
                line_.arguments.insert(line_.arguments.end(),
                                       words_.begin() + static_cast<std::ptrdiff_t>(at_),
                                       words_.end());
                break;
            }
            if (word.starts_with("--")) {
                take_long(word);
            } else if (looks_like_option(word)) {
                take_letters(word);
            } else {
                line_.arguments.push_back(word);
            }
        }
        if (std::ranges::find(line_.arguments, "") != line_.arguments.end()) {
            fail_usage("an argument is empty; name a file");
        }
        check_arguments();
        return std::move(line_);
    }

  private:
    void check_arguments() const {
        std::size_t room = 0;
        for (const OptionFacts& option : command_.options) {
            if (option.is_argument && option.repeats) {
                return;
            }
            room += option.is_argument ? 1 : 0;
        }
        if (line_.arguments.size() > room) {
            fail_usage("one argument too many: " + in_quotes(line_.arguments[room]) +
                       bare_option_hint(line_.arguments[room]));
        }
    }

    /// Returns a hint if the word stands behind an option whose value may be left out, as --weld
    /// says in its help: "--weld 1e-6".
    std::string bare_option_hint(const std::string& argument) const {
        const auto at = std::ranges::find(words_, argument);
        if (at == words_.begin() || at == words_.end() || !at[-1].starts_with("--")) {
            return "";
        }
        const auto option = std::ranges::find_if(command_.options, [&](const OptionFacts& one) {
            return std::ranges::find(one.names, at[-1]) != one.names.end();
        });
        const bool may_have_value = option != command_.options.end() &&
                                    option->text.find(at[-1] + "=") != std::string::npos;
        return may_have_value ? "; if it is the value of " + at[-1] + ", give " + at[-1] + '=' +
                                    one_line(argument)
                              : "";
    }

    void take_long(const std::string& word) {
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const OptionFacts& option = option_named(name);
        if (equals != std::string::npos) {
            add(name, word.substr(equals + 1));
        } else if (option.is_flag || (option.may_lack_value && !value_follows())) {
            line_.options.push_back(name);
        } else {
            add(name, next_value(name));
        }
    }

    /// "-q", "-qv", "-n5", "-n=5" or "-n 5".
    void take_letters(const std::string& word) {
        for (std::size_t i = 1; i < word.size(); ++i) {
            const OptionFacts& option = option_named(std::string("-") + word[i], word);
            const std::string name = long_name(option);
            if (option.is_flag) {
                line_.options.push_back(name);
                continue;
            }
            const std::string rest = word.substr(i + 1);
            if (rest.empty()) {
                add(name, next_value(name));
            } else {
                add(name, rest.starts_with('=') ? rest.substr(1) : rest);
            }
            return;
        }
    }

    const OptionFacts& option_named(const std::string& name, const std::string& word = {}) const {
        std::vector<std::string> known;
        for (const OptionFacts& option : command_.options) {
            if (!option.is_argument &&
                std::ranges::find(option.names, name) != option.names.end()) {
                return option;
            }
            known.insert(known.end(),
                         option.is_argument ? option.names.end() : option.names.begin(),
                         option.names.end());
        }
        const std::string& shown = word.empty() ? name : word;
        const std::string meant = did_you_mean(shown, known);
        fail_usage(in_quotes(shown) + ": no such option" +
                   (meant.empty() ? "; a file of this name must come after --" : meant));
    }

    static std::string long_name(const OptionFacts& option) { return option.names.back(); }

    bool value_follows() const { return at_ < words_.size() && !looks_like_option(words_[at_]); }

    std::string next_value(const std::string& name) {
        if (at_ == words_.size()) {
            fail_usage(name + " needs a value");
        }
        const std::string& word = words_[at_++];
        if (looks_like_option(word)) {
            fail_usage(name + ": needs a value before " + one_line(word) +
                       "; if that is the value, give " + name + "=" + one_line(word));
        }
        return word;
    }

    void add(const std::string& name, const std::string& value) {
        if (value.empty()) {
            fail_usage(name + ": needs a value");
        }
        line_.options.push_back(name + '=' + value);
    }

    const CommandFacts& command_;
    std::span<const std::string> words_;
    std::size_t at_ = 0; ///< The next word.
    CommandLine line_;
};

} // namespace

CommandLine sorted_words(const CommandFacts& command, std::span<const std::string> words) {
    return Sorter(command, words).sort();
}

std::vector<std::string> words_of(const CommandLine& line) {
    std::vector<std::string> words = line.options;
    if (!line.arguments.empty()) {
        words.emplace_back("--");
    }
    words.insert(words.end(), line.arguments.begin(), line.arguments.end());
    return words;
}

bool asks_for_help(std::span<const std::string> words) {
    const auto end = std::ranges::find(words, "--");
    return std::any_of(words.begin(), end,
                       [](const std::string& word) { return word == "-h" || word == "--help"; });
}

} // namespace geodisk::tools
