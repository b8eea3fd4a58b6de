#include "program/terminal.hpp"

#include <cstdlib>
#include <string_view>

#ifdef _WIN32
#include <io.h>

#include <cstdio>
#else
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

bool wants_colours() {
#ifdef _WIN32
    return false; // Consoles there take the sequences only once they are told to.
#else
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    const bool is_refused = no_color != nullptr && *no_color != '\0';
    const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
    return !is_refused && !is_dumb && stderr_is_terminal();
#endif
}

} // namespace

bool stderr_is_terminal() {
#ifdef _WIN32
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(STDERR_FILENO) == 1;
#endif
}

std::string coloured(const std::string& text, Colour colour) {
    if (!wants_colours()) {
        return text;
    }
    return (colour == Colour::red ? "\x1b[31m" : "\x1b[33m") + text + "\x1b[0m";
}

} // namespace geodisk::tools
