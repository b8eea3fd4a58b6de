#include "program/manual.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace geodisk::tools {
namespace {

/// Text that roff takes for nothing else. Lines may begin with neither "." nor "'".
std::string plain(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool begins = result.empty() || result.back() == '\n';
        if (begins && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return result;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// For a line of its own in "NAME" and lists of commands: "samples a mesh".
std::string summary(const std::string& text) {
    std::string line = text.substr(0, text.find('\n'));
    if (line.size() > 1 && std::islower(static_cast<unsigned char>(line[1])) != 0) {
        line[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(line[0])));
    }
    return line;
}

/// Lines as they are where blanks align them, else filled.
std::string paragraph(const std::string& text) {
    const bool is_aligned = text.find("  ") != std::string::npos;
    return (is_aligned ? ".nf\n" : "") + plain(text) + (is_aligned ? "\n.fi\n" : "\n");
}

void add_option(std::string& page, const OptionFacts& option) {
    std::string head;
    for (const std::string& name : option.names) {
        head += (head.empty() ? "" : ", ") +
                (option.is_argument ? "\\fI" + plain(name) : "\\fB" + plain(name)) + "\\fR";
    }
    if (!option.is_flag && !option.type.empty()) {
        head += " \\fI" + plain(option.type) + "\\fR";
    }
    page += ".TP\n" + head + '\n' + paragraph(option.text);
    std::string notes;
    if (option.is_required && !option.is_argument) {
        notes += "Must be given.\n";
    }
    if (!option.usual.empty()) {
        notes += "Default: " + plain(option.usual) + ".\n";
    }
    page += notes.empty() ? "" : ".br\n" + notes;
}

void add_options(std::string& page, const std::vector<OptionFacts>& options) {
    page += ".SH OPTIONS\n";
    std::vector<std::string> groups;
    for (const OptionFacts& option : options) {
        if (!option.group.empty() &&
            std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
            groups.push_back(option.group);
        }
    }
    for (const std::string& group : groups) {
        page += group == "Options" ? "" : ".SS " + plain(group) + '\n';
        for (const OptionFacts& option : options) {
            if (option.group == group) {
                add_option(page, option);
            }
        }
    }
}

/// Adds the end of help: indented lines under headings that end with a colon, and paragraphs.
void add_footer(std::string& page, const std::string& footer) {
    std::istringstream lines(footer);
    bool is_indented = false;
    for (std::string line; std::getline(lines, line);) {
        const bool indents = line.starts_with(' ');
        if (indents != is_indented) {
            page += indents ? ".nf\n" : ".fi\n";
            is_indented = indents;
            page += !indents && !line.empty() && !line.ends_with(':') ? ".PP\n" : "";
        }
        if (line.empty()) {
            continue;
        }
        page += line.ends_with(':') && !indents
                    ? ".SH " + upper(plain(line.substr(0, line.size() - 1)))
                    : plain(line);
        page += '\n';
    }
    page += is_indented ? ".fi\n" : "";
}

/// "geodisk sample" for a command of geodisk.
std::string page_of(const CommandFacts& command, const std::string& invoked,
                    const std::string& version) {
    std::string name = invoked;
    std::replace(name.begin(), name.end(), ' ', '-');
    std::string page = ".TH " + upper(plain(name)) + " 1 \"\" \"" + plain(version) +
                       "\" \"User Commands\"\n.SH NAME\n" + plain(name) + " \\- " +
                       plain(summary(command.text)) + "\n.SH SYNOPSIS\n.B " + plain(invoked) +
                       "\n[OPTIONS]";
    for (const OptionFacts& option : command.options) {
        if (option.is_argument) {
            const std::string words =
                "\\fI" + plain(option.names.front()) + "\\fR" + (option.repeats ? " ..." : "");
            page += option.is_required ? ' ' + words : " [" + words + ']';
        }
    }
    page += command.commands.empty() ? "\n" : " COMMAND ...\n";
    page += ".SH DESCRIPTION\n" + plain(command.text) + ".\n";
    return page;
}

} // namespace

std::vector<ManualPage> manual_pages(const CommandFacts& program, const std::string& version) {
    std::string main = page_of(program, program.name, version);
    add_options(main, program.options);
    main += ".SH COMMANDS\n";
    std::vector<ManualPage> pages;
    for (const CommandFacts& command : program.commands) {
        const std::string name = program.name + '-' + command.name;
        main += ".TP\n\\fB" + plain(name) + "\\fR(1)\n" + plain(command.text) + '\n';
        std::string page = page_of(command, program.name + ' ' + command.name, version);
        add_options(page, command.options);
        add_footer(page, command.footer);
        page += ".SH SEE ALSO\n.BR " + plain(program.name) + " (1)\n";
        pages.push_back({name + ".1", std::move(page)});
    }
    add_footer(main, program.footer);
    pages.insert(pages.begin(), {program.name + ".1", std::move(main)});
    return pages;
}

} // namespace geodisk::tools
