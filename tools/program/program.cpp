#include "program/program.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "program/command_line.hpp"
#include "program/command_text.hpp"
#include "program/crash.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/standard_streams.hpp"
#include "program/suggestion.hpp"
#include "program/terminal.hpp"
#include "program/utf8_arguments.hpp"

namespace geodisk::tools {
namespace {

std::string noted_name = "geodisk", noted_command;

int fail(const char* program, ExitCode code, const std::string& message) {
    std::cout.flush();
    if (message.empty()) {
        return static_cast<int>(code);
    }
    const std::string mark = std::string(program) + ':';
    const bool is_signal = static_cast<int>(code) > 128; // Which was wanted, so no error.
    std::cerr << (is_signal ? mark : coloured(mark, Colour::red)) << ' ' << one_line(message)
              << '\n';
    return static_cast<int>(code);
}

/// Returns where the user finds the right usage.
std::string hint(const std::string& program, const std::string& command) {
    return " (see " + program + ' ' + (command.empty() ? "" : command + ' ') + "--help)";
}

/// CLI11 counts values; people want to know what they did.
std::string usage_message(const CLI::ParseError& error) {
    std::string message = error.what();
    const std::string option = message.substr(0, message.find(':'));
    if (message.find("At Most 1 required") != std::string::npos) {
        return option + " is given more than once";
    }
    if (message.find("1 required") != std::string::npos) {
        return option + " needs a value";
    }
    return message;
}

/// The command that `arguments` begin with, or "". Throws UserError(usage) where there must be one
/// and it is another word.
std::string chosen_command(Command program, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments.front().starts_with('-')) {
        return "";
    }
    const std::string& first = arguments.front();
    if (program.find_command(first)) {
        return first;
    }
    if (const std::vector<std::string> names = program.command_names(); !names.empty()) {
        fail_usage(in_quotes(first) + ": no such command" + did_you_mean(first, names));
    }
    return "";
}

/// `arguments` as CLI11 takes them: backwards, with nothing left to guess.
std::vector<std::string> understood(Command program, const std::string& command,
                                    std::vector<std::string> arguments) {
    std::vector<std::string> words;
    if (!command.empty()) {
        words.push_back(command);
        arguments.erase(arguments.begin());
    }
    const Command chosen = command.empty() ? program : *program.find_command(command);
    const std::vector<std::string> rest =
        asks_for_help(arguments) ? std::vector<std::string>{"--help"}
                                 : words_of(sorted_words(chosen.facts(true), arguments));
    words.insert(words.end(), rest.begin(), rest.end());
    std::reverse(words.begin(), words.end());
    return words;
}

int parse(CLI::App& app, Command program, int argc, char** argv, Rewrite rewrite) {
    const char* const name = app.get_name().c_str();
    std::string command;
    try {
        std::vector<std::string> arguments = utf8_arguments(argc, argv);
        noted_command = command_text(name, arguments);
        if (rewrite != nullptr) {
            rewrite(program, arguments);
        }
        if (arguments.empty() && !program.command_names().empty()) {
            std::cerr << app.help();
            return static_cast<int>(ExitCode::usage);
        }
        command = chosen_command(program, arguments);
        app.parse(understood(program, command, std::move(arguments)));
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help(); // Of the subcommand if one is chosen.
    } catch (const CLI::CallForVersion& version) {
        std::cout << version.what() << '\n';
    } catch (const CLI::ParseError& error) {
        return fail(name, ExitCode::usage, usage_message(error) + hint(name, command));
    } catch (const UserError& error) {
        const bool is_usage = error.code() == ExitCode::usage;
        return fail(name, error.code(), error.what() + (is_usage ? hint(name, command) : ""));
    }
    if (!std::cout.flush()) {
        return fail(name, ExitCode::bad_output, "standard output cannot be written");
    }
    return 0;
}

int run(const char* name, const char* description, SetUp set_up, int argc, char** argv,
        Rewrite rewrite) {
    try {
        CLI::App app(description, name);
        NotesByOption notes;
        const Command program(app, notes);
        set_up(program);
        return parse(app, program, argc, argv, rewrite);
    } catch (const std::bad_alloc&) {
        return fail(name, ExitCode::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        return fail(name, ExitCode::internal, error.what());
    }
}

} // namespace

const std::string& program_name() {
    return noted_name;
}

const std::string& given_command() {
    return noted_command;
}

void run_arguments(const std::function<void(Command)>& set_up, std::vector<std::string> arguments) {
    CLI::App app;
    app.set_help_flag();
    NotesByOption notes;
    const Command program(app, notes);
    set_up(program);
    const std::string command = chosen_command(program, arguments);
    try {
        app.parse(understood(program, command, std::move(arguments)));
    } catch (const CLI::ParseError& error) {
        fail_usage(usage_message(error));
    }
}

std::vector<std::string> words_of(const std::function<void(Command)>& set_up,
                                  const std::function<void(Command)>& set_up_usual) {
    CLI::App app, usual_app;
    NotesByOption notes, usual_notes;
    const Command command(app, notes), usual(usual_app, usual_notes);
    set_up(command);
    set_up_usual(usual);
    return command.words(usual);
}

int run_program(const char* name, const char* description, SetUp set_up, int argc, char** argv,
                Rewrite rewrite) {
    noted_name = name;
    occupy_closed_streams();
    install_signal_handlers(name);
    install_crash_handlers(name);
    const int status = run(name, description, set_up, argc, argv, rewrite);
    expect_exit();
    return status;
}

} // namespace geodisk::tools
