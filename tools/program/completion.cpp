#include "program/completion.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "program/command_text.hpp"

namespace geodisk::tools {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, std::string_view between) {
    std::string all;
    for (const std::string& word : words) {
        all += (all.empty() ? "" : std::string(between)) + word;
    }
    return all;
}

Words names_of(const std::vector<CommandFacts>& commands) {
    Words names;
    for (const CommandFacts& command : commands) {
        names.push_back(command.name);
    }
    return names;
}

bool is_folder(const OptionFacts& option) {
    return option.type == "DIR";
}

bool is_file(const OptionFacts& option) {
    return option.is_argument || option.type == "FILE" || option.type == "OUT";
}

// Start of bash_completion(); `option` is the one whose value `word` is, or "".
constexpr const char* kBashStart =
    R"(    # By the line, as the words that bash makes of it end at ":" and "=" too.
    local line=${COMP_LINE:0:COMP_POINT} word='' option='' options='' offered='' kind='' ended=''
    local -a words
    read -ra words <<< "$line"
    if [[ $line != *[[:blank:]] ]]; then
        word=${words[-1]}
        unset 'words[-1]'
    fi
    if [[ " ${words[*]:1} " == *' -- '* ]]; then
        ended=yes
    elif [[ $word == --*=* ]]; then
        option=${word%%=*}
        word=${word#*=}
    elif ((${#words[@]} > 2)); then
        option=${words[-1]}
    fi
)";

constexpr const char* kBashEnd = R"(    COMPREPLY=()
    if [[ $kind != files || -z $(compgen -f -- "$word") ]]; then
        COMPREPLY=($(compgen -W "$offered" -- "$word" || true))
    fi
    # bash puts them behind the last ":".
    if [[ $word == *:* && $COMP_WORDBREAKS == *:* ]]; then
        COMPREPLY=("${COMPREPLY[@]#"${word%:*}:"}")
    fi
    case ${#COMPREPLY[@]}$kind in
        0files | 0command) compopt -o default 2> /dev/null ;;
        0folders) compopt -o dirnames 2> /dev/null ;;
    esac
    return 0
}
)";

std::string bash_case(const CommandFacts& command, const std::string& pattern) {
    Words names, files, folders, others, arguments;
    std::string cases;
    const auto add_case = [&cases](const Words& options, const std::string& does) {
        if (!options.empty()) {
            cases += "                " + joined(options, " | ") + ") " + does + " ;;\n";
        }
    };
    for (const OptionFacts& option : command.options) {
        if (option.is_argument) {
            arguments.insert(arguments.end(), option.offers.begin(), option.offers.end());
            continue;
        }
        names.insert(names.end(), option.names.begin(), option.names.end());
        if (!option.offers.empty()) {
            add_case(option.names, "kind=words offered='" + joined(option.offers, " ") + "'");
        } else if (!option.is_flag) {
            Words& kind = is_folder(option) ? folders : is_file(option) ? files : others;
            kind.insert(kind.end(), option.names.begin(), option.names.end());
        }
    }
    add_case(files, "kind=files");
    add_case(folders, "kind=folders");
    add_case(others, "kind=words");
    // Those of two meshes are the same.
    std::sort(arguments.begin(), arguments.end());
    arguments.erase(std::unique(arguments.begin(), arguments.end()), arguments.end());
    return "        " + pattern + ")\n            options='" + joined(names, " ") +
           "'\n            case $option in\n" + cases + "                *) kind=files offered='" +
           joined(arguments, " ") + "' ;;\n            esac\n            ;;\n";
}

/// `text` where zsh takes brackets and colons for its own.
std::string zsh_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result;
}

/// The first part of a text, on one line.
std::string beginning(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.substr(0, text.find("; "));
}

/// Returns what zsh does for a value.
std::string zsh_action(const OptionFacts& option) {
    if (is_folder(option)) {
        return "_files -/";
    }
    if (is_file(option)) {
        return option.offers.empty()
                   ? "_files"
                   : "{_files; compadd -- " + zsh_text(joined(option.offers, " ")) + '}';
    }
    return option.offers.empty() ? " " : '(' + zsh_text(joined(option.offers, " ")) + ')';
}

void add_zsh_specs(Words& specs, const OptionFacts& option) {
    if (option.is_argument) {
        specs.push_back((option.repeats ? "*:" : ":") + zsh_text(option.names.front()) + ':' +
                        zsh_action(option));
        return;
    }
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        std::string spec = option.repeats ? "*" : '(' + joined(option.names, " ") + ')';
        spec += name + (option.is_flag ? "" : is_long ? "=" : "+");
        spec += '[' + zsh_text(beginning(option.text)) + ']';
        if (!option.is_flag) {
            spec += ':' + zsh_text(option.type) + ':' + zsh_action(option);
        }
        specs.push_back(std::move(spec));
    }
}

std::string zsh_arguments(const CommandFacts& command, const std::string& indent) {
    Words specs;
    for (const OptionFacts& option : command.options) {
        add_zsh_specs(specs, option);
    }
    std::string lines;
    for (const std::string& spec : specs) {
        lines += " \\\n" + indent + "    " + in_shell_quotes(spec);
    }
    return lines;
}

} // namespace

std::string bash_completion(const CommandFacts& program, const std::string& usual) {
    std::string script = "# Completion for bash.\n_" + program.name + "() {\n" + kBashStart;
    script += "    case ${words[1]-} in\n        '')\n            kind=command offered='" +
              joined(names_of(program.commands), " ") + "'\n            options='";
    Words names;
    for (const OptionFacts& option : program.options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    script += joined(names, " ") + "'\n            ;;\n";
    for (const CommandFacts& command : program.commands) {
        script += bash_case(command, command.name);
    }
    for (const CommandFacts& command : program.commands) {
        script += command.name == usual ? bash_case(command, "*") : "";
    }
    script += "    esac\n"
              "    if [[ $word == -* && -z $ended ]]; then\n"
              "        kind=words offered=$options\n"
              "    fi\n";
    return script + kBashEnd + "complete -F _" + program.name + ' ' + program.name + '\n';
}

std::string zsh_completion(const CommandFacts& program, const std::string& usual) {
    const std::string& name = program.name;
    std::string script = "#compdef " + name + "\n_" + name + "() {\n";
    script += "    local curcontext=$curcontext state line\n    _arguments -C" +
              zsh_arguments(program, "    ") + " \\\n        '1: :->command' '*:: :->rest'\n";
    script += "    case $state in\n        command)\n            local -a commands=(\n";
    for (const CommandFacts& command : program.commands) {
        script += "                " +
                  in_shell_quotes(command.name + ':' + zsh_text(beginning(command.text))) + '\n';
    }
    script += "            )\n            _describe -t commands command commands\n"
              "            _files\n            ;;\n        rest)\n            case $words[1] in\n";
    for (const CommandFacts& command : program.commands) {
        script += "                " + command.name + ") _arguments -s" +
                  zsh_arguments(command, std::string(20, ' ')) + " ;;\n";
    }
    for (const CommandFacts& command : program.commands) {
        script += command.name == usual ? "                *) _arguments -s" +
                                              zsh_arguments(command, std::string(20, ' ')) + " ;;\n"
                                        : "";
    }
    script += "            esac\n            ;;\n    esac\n}\n";
    // zsh calls a file of its fpath once as the function, which defined itself by that.
    return script + "if [[ $funcstack[1] == _" + name + " ]]; then\n    _" + name +
           " \"$@\"\nelse\n    compdef _" + name + ' ' + name + "\nfi\n";
}

} // namespace geodisk::tools
