#include "program/program.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "program/crash.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/standard_streams.hpp"
#include "program/utf8_arguments.hpp"

namespace geodisk::tools {
namespace {

int fail(const CLI::App& app, ExitCode code, const std::string& message) {
    std::cout.flush();
    std::cerr << app.get_name() << ": " << one_line(message) << '\n';
    return static_cast<int>(code);
}

/// Where the user finds the right usage.
std::string hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return " (see " + app.get_name() + " " +
           (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help)";
}

/// CLI11 counts values; people want to know what they did.
std::string usage_message(const CLI::ParseError& error) {
    const std::string message = error.what();
    const std::string option = message.substr(0, message.find(':'));
    if (message.find("At Most 1 required") != std::string::npos) {
        return option + " is given more than once";
    }
    if (message.find("1 required") != std::string::npos) {
        return option + " needs a value";
    }
    return message;
}

/// CLI11 would give "--name=" the argument behind it.
void check_values(const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) {
        if (argument == "--") {
            return;
        }
        if (argument.starts_with("--") && argument.ends_with('=')) {
            fail_usage(argument.substr(0, argument.size() - 1) + " needs a value");
        }
    }
}

int run(CLI::App& app, int argc, char** argv) {
    try {
        std::vector<std::string> arguments = utf8_arguments(argc, argv);
        check_values(arguments);
        std::reverse(arguments.begin(), arguments.end()); // As CLI11 takes them.
        app.parse(arguments);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help(); // Of the subcommand if one is chosen.
    } catch (const CLI::CallForVersion& version) {
        std::cout << version.what() << '\n';
    } catch (const CLI::ParseError& error) {
        return fail(app, ExitCode::usage, usage_message(error) + hint(app));
    } catch (const UserError& error) {
        const bool is_usage = error.code() == ExitCode::usage;
        return fail(app, error.code(), error.what() + (is_usage ? hint(app) : ""));
    } catch (const std::bad_alloc&) {
        return fail(app, ExitCode::out_of_memory, "the memory of this machine does not suffice");
    } catch (const std::exception& error) {
        return fail(app, ExitCode::internal, error.what());
    }
    if (!std::cout.flush()) {
        return fail(app, ExitCode::bad_output, "standard output cannot be written");
    }
    return 0;
}

} // namespace

std::string fault_of_value(const std::string& given) {
    if (given.empty()) {
        return "needs a value";
    }
    const bool is_option = given.size() > 1 && given[0] == '-' &&
                           (given[1] == '-' || (given[1] >= 'a' && given[1] <= 'z') ||
                            (given[1] >= 'A' && given[1] <= 'Z'));
    return is_option ? "needs a value before " + given : "";
}

int run_program(CLI::App& app, int argc, char** argv) {
    occupy_closed_streams();
    const std::string name = app.get_name();
    install_signal_handlers(name.c_str());
    install_crash_handlers(name.c_str());
    const int status = run(app, argc, argv);
    expect_exit();
    return status;
}

} // namespace geodisk::tools
