// The frame of a command line program: its options, and how it parses, runs, and turns every
// failure into one line and an exit status.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/command.hpp"

namespace geodisk::tools {

/// Gives a program its options and commands, whose callbacks do the work.
using SetUp = void (*)(Command);

/// Turns the arguments of a program so set up into others. Throws UserError.
using Rewrite = void (*)(Command, std::vector<std::string>&);

/// The body of main(): sets the program up, parses the arguments, and returns the exit status of
/// the process. Prints help and version to standard output, and "NAME: MESSAGE" to standard error
/// for any exception, signal and crash.
int run_program(const char* name, const char* description, SetUp set_up, int argc, char** argv,
                Rewrite rewrite = nullptr);

/// Does what these arguments ask for of a program so set up: what one of its commands does, as a
/// step of another. Throws what that throws, and UserError(usage) for arguments that are none.
void run_arguments(const std::function<void(Command)>& set_up, std::vector<std::string> arguments);

/// Returns options as they are typed, with the values that they have now: those that `set_up` adds
/// to a command, but for those that have the same values where `set_up_usual` adds them.
std::vector<std::string> words_of(const std::function<void(Command)>& set_up,
                                  const std::function<void(Command)>& set_up_usual);

/// The name that run_program() was called with, as messages begin with it.
const std::string& program_name();

/// The command that run_program() was called by, as a line for a shell.
const std::string& given_command();

} // namespace geodisk::tools
