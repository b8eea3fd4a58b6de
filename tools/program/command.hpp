// The options and commands of a program. CLI11 parses them; its headers take seconds to compile, so
// only the sources of this folder know it.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace geodisk::tools {

/// An option, flag or argument of a command: a handle, valid as long as the program parses.
class Option {
  public:
    Option() = default;
    explicit Option(CLI::Option* option) : option_(option) {}

    /// It must be given.
    Option required() const;
    /// Help shows the value it has now, or `text`.
    Option shows_default() const;
    Option shows_default(const std::string& text) const;
    /// It may be given several times, with one value each.
    Option takes_one_value() const;
    /// Its values are given as one, with commas between.
    Option takes_commas() const;
    /// Its value is of [low, high].
    Option takes_range(int low, int high) const;
    /// It may be given only where `other` is.
    Option needs(Option other) const;

    /// Whether it was on the command line; known once parsed.
    bool is_given() const;

  private:
    CLI::Option* option_ = nullptr;
};

/// A program or one of its subcommands: a handle, valid as long as the program parses.
class Command {
  public:
    explicit Command(CLI::App& app) : app_(&app) {}

    /// Adds an option: its names, where its value goes, what help calls the value (TYPE), what it
    /// is for, and under which heading help lists it. Value: double, int, std::uint32_t,
    /// std::string or std::vector<std::string>.
    template <class Value>
    Option add_option(const std::string& names, Value& value, const std::string& type,
                      const std::string& text, const std::string& group = "Options") const;

    /// Adds an option whose value `take` reads; it throws UserError(usage) where that is no value.
    Option add_reader(const std::string& names, const std::function<void(const std::string&)>& take,
                      const std::string& type, const std::string& text,
                      const std::string& group = "Options") const;

    /// Adds an option that is set when it is given. Value: bool, or std::string, which is then
    /// "true" or what follows a "=".
    template <class Value>
    Option add_flag(const std::string& names, Value& value, const std::string& text,
                    const std::string& group = "Options") const;

    Command add_command(const std::string& name, const std::string& text) const;
    bool has_command(const std::string& name) const;
    /// One of its subcommands must be given.
    void needs_command() const;

    /// What --version prints.
    void has_version(const std::string& text) const;
    /// What help ends with.
    void has_footer(const std::string& text) const;
    /// Does its work, once all is parsed.
    void calls(std::function<void()> run) const;

  private:
    CLI::App* app_;
};

} // namespace geodisk::tools
