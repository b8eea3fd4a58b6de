// The options and commands of a program. CLI11 parses them; its headers take seconds to compile, so
// only the sources of this folder know it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace geodisk::tools {

/// What a flag of text is set to where no value follows it.
inline constexpr const char* kBareFlag = "true";

/// Facts about an option, flag or argument, for manuals and completion.
struct OptionFacts {
    std::vector<std::string> names; ///< With their dashes, or of an argument its one name.
    std::string type;               ///< Type of its value, as help names it.
    std::string usual;              ///< The value it has when not given, where help shows it.
    std::string text, group;
    bool is_argument = false, is_flag = false, is_required = false, repeats = false;
    bool may_lack_value = false;
    std::vector<std::string> offers; ///< Values to choose from, of those there may be.
};

/// Facts about a program or one of its subcommands.
struct CommandFacts {
    std::string name, text, footer;
    std::vector<OptionFacts> options;
    std::vector<CommandFacts> commands;
};

/// NotesByOption on an option.
struct OptionNotes {
    std::vector<std::string> offers; ///< Values that completion offers.
    /// Returns the values that the option has now: none where it would not be given.
    std::function<std::vector<std::string>()> values;
};
using NotesByOption = std::map<const CLI::Option*, OptionNotes>;

/// An option, flag or argument of a command: a handle, valid as long as the program parses.
class Option {
  public:
    Option() = default;
    Option(CLI::Option* option, NotesByOption& notes) : option_(option), notes_(&notes) {}

    /// It must be given.
    Option required() const;
    /// Help shows the value it has now, or `text`.
    Option shows_default() const;
    Option shows_default(const std::string& text) const;
    /// It may be given several times, with one value each.
    Option takes_one_value() const;
    /// It may be given without its value, which is then "".
    Option may_lack_value() const;
    /// Its values are given as one, with commas between.
    Option takes_commas() const;
    /// Its value is of [low, high].
    Option takes_range(int low, int high) const;
    /// It may be given only where `other` is.
    Option needs(Option other) const;
    /// Completion offers these values; others may be right as well.
    Option offers(std::vector<std::string> values) const;

    /// Returns true if it was on the command line; known once parsed.
    bool is_given() const;

  private:
    CLI::Option* option_ = nullptr;
    NotesByOption* notes_ = nullptr;
};

/// A program or one of its subcommands: a handle, valid as long as the program parses.
class Command {
  public:
    Command(CLI::App& app, NotesByOption& notes) : app_(&app), notes_(&notes) {}

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
    /// kBareFlag or what follows a "=".
    template <class Value>
    Option add_flag(const std::string& names, Value& value, const std::string& text,
                    const std::string& group = "Options") const;

    Command add_command(const std::string& name, const std::string& text) const;
    /// The same, of no interest to most: help, manuals and completion do not tell of it.
    Command add_hidden_command(const std::string& name, const std::string& text) const;
    /// Nothing if there is no such command.
    std::optional<Command> find_command(const std::string& name) const;
    /// Those that help tells of.
    std::vector<std::string> command_names() const;
    /// One of its subcommands must be given.
    void needs_command() const;

    /// Sets what --version prints.
    void has_version(const std::string& text) const;
    /// Sets what help ends with.
    void has_footer(const std::string& text) const;
    /// Does its work, once all is parsed.
    void calls(std::function<void()> run) const;

    /// Describes the command; with `with_hidden`, also options that help does not show.
    CommandFacts facts(bool with_hidden = false) const;

    /// Returns its options with their values, as they are typed, but for those that have the same
    /// values in `usual`, a command with the same options.
    std::vector<std::string> words(const Command& usual) const;

  private:
    CLI::App* app_;
    NotesByOption* notes_;
};

} // namespace geodisk::tools
