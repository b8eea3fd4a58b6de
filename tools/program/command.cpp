#include "program/command.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace geodisk::tools {
namespace {

CLI::Option* described(CLI::Option* option, const std::string& type, const std::string& group) {
    return option->type_name(type)->group(group);
}

OptionFacts facts_of(const CLI::Option& option, const Offers& offers) {
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
    if (const auto found = offers.find(&option); found != offers.end()) {
        facts.offers = found->second;
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
    (*offers_)[option_] = std::move(values);
    return *this;
}

bool Option::is_given() const {
    return option_->count() > 0;
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& type,
                           const std::string& text, const std::string& group) const {
    return {described(app_->add_option(names, value, text), type, group), *offers_};
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
            *offers_};
}

template <class Value>
Option Command::add_flag(const std::string& names, Value& value, const std::string& text,
                         const std::string& group) const {
    return {app_->add_flag(names, value, text)->group(group), *offers_};
}

template Option Command::add_flag(const std::string&, bool&, const std::string&,
                                  const std::string&) const;
template Option Command::add_flag(const std::string&, std::string&, const std::string&,
                                  const std::string&) const;

Command Command::add_command(const std::string& name, const std::string& text) const {
    return {*app_->add_subcommand(name, text), *offers_};
}

Command Command::add_hidden_command(const std::string& name, const std::string& text) const {
    return {*app_->add_subcommand(name, text)->group(""), *offers_};
}

std::optional<Command> Command::find_command(const std::string& name) const {
    const auto has_name = [&name](CLI::App* one) { return one->check_name(name); };
    const auto found = app_->get_subcommands(std::function<bool(CLI::App*)>(has_name));
    return found.empty() ? std::nullopt : std::optional(Command(*found.front(), *offers_));
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
            facts.options.push_back(facts_of(*option, *offers_));
        }
    }
    for (CLI::App* command : app_->get_subcommands(std::function<bool(CLI::App*)>())) {
        if (!command->get_group().empty()) {
            facts.commands.push_back(Command(*command, *offers_).facts(with_hidden));
        }
    }
    return facts;
}

} // namespace geodisk::tools
