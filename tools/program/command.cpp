#include "program/command.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace geodisk::tools {
namespace {

/// What is wrong with what was given as the value of an option, or "": nothing, or another option,
/// which CLI11 would take for it.
std::string fault_of_value(const std::string& given) {
    if (given.empty()) {
        return "needs a value";
    }
    const bool is_option = given.size() > 1 && given[0] == '-' &&
                           (given[1] == '-' || (given[1] >= 'a' && given[1] <= 'z') ||
                            (given[1] >= 'A' && given[1] <= 'Z'));
    return is_option ? "needs a value before " + given : "";
}

Option described(CLI::Option* option, const std::string& type, const std::string& group) {
    return Option(option->type_name(type)->group(group)->check(fault_of_value, "", ""));
}

} // namespace

Option Option::required() const {
    return Option(option_->required());
}

Option Option::shows_default() const {
    return Option(option_->capture_default_str());
}

Option Option::shows_default(const std::string& text) const {
    return Option(option_->default_str(text));
}

Option Option::takes_one_value() const {
    return Option(option_->allow_extra_args(false));
}

Option Option::takes_commas() const {
    return Option(option_->delimiter(','));
}

Option Option::takes_range(int low, int high) const {
    return Option(option_->check(CLI::Range(low, high).description("")));
}

Option Option::needs(Option other) const {
    return Option(option_->needs(other.option_));
}

bool Option::is_given() const {
    return option_->count() > 0;
}

template <class Value>
Option Command::add_option(const std::string& names, Value& value, const std::string& type,
                           const std::string& text, const std::string& group) const {
    return described(app_->add_option(names, value, text), type, group);
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
    return described(app_->add_option_function<std::string>(names, take, text), type, group);
}

template <class Value>
Option Command::add_flag(const std::string& names, Value& value, const std::string& text,
                         const std::string& group) const {
    return Option(app_->add_flag(names, value, text)->group(group));
}

template Option Command::add_flag(const std::string&, bool&, const std::string&,
                                  const std::string&) const;
template Option Command::add_flag(const std::string&, std::string&, const std::string&,
                                  const std::string&) const;

Command Command::add_command(const std::string& name, const std::string& text) const {
    return Command(*app_->add_subcommand(name, text));
}

bool Command::has_command(const std::string& name) const {
    const auto has_name = [&name](CLI::App* one) { return one->check_name(name); };
    return !app_->get_subcommands(std::function<bool(CLI::App*)>(has_name)).empty();
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

} // namespace geodisk::tools
