#include "program/command.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

CLI::Option* described(CLI::Option* option, const std::string& type, const std::string& group) {
    return option->type_name(type)->group(group);
}

std::vector<std::string> texts_of(bool is_set) {
    return is_set ? std::vector<std::string>{"true"} : std::vector<std::string>();
}

std::vector<std::string> texts_of(const std::string& text) {
    return text.empty() ? std::vector<std::string>() : std::vector{text};
}

std::vector<std::string> texts_of(const std::vector<std::string>& texts) {
    return texts;
}

template <class Number>
std::vector<std::string> texts_of(Number number) {
    return {exact_text(number)};
}

OptionFacts facts_of(const CLI::Option& option, const NotesByOption& notes) {
    OptionFacts facts;
    facts.is_argument = option.get_positional();
    if (facts.is_argument) {
        facts.names.push_back(option.get_name(true));
    }
    for (const std::string& name : option.get_snames()) {
        facts.names.push_back('-' + name);
    }
    for (const std::string& name : option.get_lnames()) {
        facts.names.push_back("--" + name);
    }
    facts.is_flag = option.get_items_expected_max() == 0;
    facts.may_lack_value = !facts.is_flag && option.get_items_expected_min() == 0;
    facts.type = facts.is_flag ? "" : option.get_type_name();
    facts.usual = option.get_default_str();
    facts.text = option.get_description();
    facts.group = option.get_group();
    facts.is_required = option.get_required();
    facts.repeats = option.get_expected_max() > 1;
    if (const auto found = notes.find(&option); found != notes.end()) {
        facts.offers = found->second.offers;
    }
    return facts;
}

} // namespace

Option Option::required() const {
    option_->required();
    return *this;
}

Option Option::shows_default() const {
    option_->capture_default_str();
    return *this;
}

Option Option::shows_default(const std::string& text) const {
    option_->default_str(text);
    return *this;
}

Option Option::takes_one_value() const {
    option_->allow_extra_args(false);
    return *this;
}

Option Option::may_lack_value() const {
    option_->expected(0, 1);
    return *this;
}

Option Option::takes_commas() const {
    option_->delimiter(',');
    return *this;
}

Option Option::takes_range(int low, int high) const {
    option_->check(CLI::Range(low, high).description(""));
    return *this;
}

Option Option::needs(Option other) const {
    option_->needs(other.option_);
    return *this;
}

Option Option::offers(std::vector<std::string> values) const {
    (*notes_)[option_].offers = std::move(values);
    return *this;
}

bool Option::is_given() const {
    return option_->count() > 0;
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& type,
                           const std::string& text, const std::string& group) const {
    CLI::Option* const option = described(app_->add_option(names, value, text), type, group);
    (*notes_)[option].values = [&value] { return texts_of(value); };
    return {option, *notes_};
}

template Option Command::add_option(const std::string&, double&, const std::string&,
                                    const std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, int&, const std::string&,
                                    const std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint32_t&, const std::string&,
                                    const std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::string&, const std::string&,
                                    const std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&,
                                    const std::string&, const std::string&,
                                    const std::string&) const;

Option Command::add_reader(const std::string& names,
                           const std::function<void(const std::string&)>& take,
                           const std::string& type, const std::string& text,
                           const std::string& group) const {
    return {described(app_->add_option_function<std::string>(names, take, text), type, group),
            *notes_};
}

template <class Value>
Option Command::add_flag(const std::string& names, Value& value, const std::string& text,
                         const std::string& group) const {
    CLI::Option* const option = app_->add_flag(names, value, text)->group(group);
    (*notes_)[option].values = [&value] { return texts_of(value); };
    return {option, *notes_};
}

template Option Command::add_flag(const std::string&, bool&, const std::string&,
                                  const std::string&) const;
template Option Command::add_flag(const std::string&, std::string&, const std::string&,
                                  const std::string&) const;

Command Command::add_command(const std::string& name, const std::string& text) const {
    return {*app_->add_subcommand(name, text), *notes_};
}

Command Command::add_hidden_command(const std::string& name, const std::string& text) const {
    return {*app_->add_subcommand(name, text)->group(""), *notes_};
}

std::optional<Command> Command::find_command(const std::string& name) const {
    const auto has_name = [&name](CLI::App* one) { return one->check_name(name); };
    const auto found = app_->get_subcommands(std::function<bool(CLI::App*)>(has_name));
    return found.empty() ? std::nullopt : std::optional(Command(*found.front(), *notes_));
}

std::vector<std::string> Command::command_names() const {
    std::vector<std::string> names;
    for (const CLI::App* command : app_->get_subcommands(std::function<bool(CLI::App*)>())) {
        if (!command->get_group().empty()) {
            names.push_back(command->get_name());
        }
    }
    return names;
}

void Command::needs_command() const {
    app_->require_subcommand(1);
}

void Command::has_version(const std::string& text) const {
    app_->set_version_flag("--version", text);
}

void Command::has_footer(const std::string& text) const {
    app_->footer(text);
}

void Command::calls(std::function<void()> run) const {
    app_->callback(std::move(run));
}

CommandFacts Command::facts(bool with_hidden) const {
    CommandFacts facts{app_->get_name(), app_->get_description(), app_->get_footer(), {}, {}};
    const CLI::App& app = *app_;
    for (const CLI::Option* option : app.get_options()) {
        if (with_hidden || !option->get_group().empty()) {
            facts.options.push_back(facts_of(*option, *notes_));
        }
    }
    for (CLI::App* command : app_->get_subcommands(std::function<bool(CLI::App*)>())) {
        if (!command->get_group().empty()) {
            facts.commands.push_back(Command(*command, *notes_).facts(with_hidden));
        }
    }
    return facts;
}

std::vector<std::string> Command::words(const Command& usual) const {
    std::vector<std::string> words;
    const CLI::App& app = *app_;
    for (const CLI::Option* const option : app.get_options()) {
        const auto noted = notes_->find(option);
        if (noted == notes_->end() || !noted->second.values) {
            continue;
        }
        const std::string name = "--" + option->get_lnames().front();
        const CLI::Option* const twin = usual.app_->get_option(name);
        const std::vector<std::string> values = noted->second.values();
        if (values == usual.notes_->at(twin).values()) {
            continue;
        }
        for (const std::string& value : values) {
            if (option->get_items_expected_max() > 0) {
                words.insert(words.end(), {name, value});
            } else {
                words.push_back(value == "true" ? name : name + '=' + value);
            }
        }
    }
    return words;
}

} // namespace geodisk::tools
