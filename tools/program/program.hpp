// The frame of a command line program: its options, and how it parses, runs, and turns every
// failure into one line and an exit status.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "program/human_text.hpp"

namespace geodisk::tools {

/// What is wrong with what was given as the value of an option, or "": nothing, or another option,
/// which CLI11 would take for it.
std::string fault_of_value(const std::string& given);

/// Adds an option: its names, where its value goes, what help calls the value (TYPE), what it is
/// for, and under which heading help lists it.
template <class Value>
CLI::Option* add_option(CLI::App& command, const std::string& names, Value& value,
                        const std::string& type, const std::string& text,
                        const std::string& group = "Options") {
    return command.add_option(names, value, text)
        ->type_name(type)
        ->group(group)
        ->check(fault_of_value, "", "");
}

/// Gives a program its options and commands, whose callbacks do the work.
using SetUp = void (*)(CLI::App&);

/// The body of main(): sets the program up, parses the arguments, and returns the exit status of
/// the process. Prints help and version to standard output, and "NAME: MESSAGE" to standard error
/// for any exception, signal and crash.
int run_program(const char* name, const char* description, SetUp set_up, int argc, char** argv);

/// The command that run_program() was called by, as a line for a shell.
const std::string& given_command();

} // namespace geodisk::tools
