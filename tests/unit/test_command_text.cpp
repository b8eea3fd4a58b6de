// Commands as a shell reads them.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "program/command_text.hpp"

namespace geodisk::tools {

TEST_CASE("words are quoted where a shell would read them otherwise") {
    CHECK(shell_word("--count=1e5") == "--count=1e5");
    CHECK(shell_word("a/b_c-d.ply") == "a/b_c-d.ply");
    CHECK(shell_word("1%") == "1%");
    CHECK(shell_word("") == "''");
    CHECK(shell_word("a b") == "'a b'");
    CHECK(shell_word("$HOME") == "'$HOME'");
    CHECK(shell_word("~") == "'~'");
    CHECK(shell_word("it's") == "'it'\\''s'");
    CHECK(shell_word("сетка 網") == "'сетка 網'");
}

TEST_CASE("what is not UTF-8, or no text, is escaped") {
    CHECK(shell_word("a\xff.obj") == "$'a\\xff.obj'");
    CHECK(shell_word("a\nb") == "$'a\\x0ab'");
    CHECK(shell_word("\x1b[31m'\\") == "$'\\x1b[31m\\'\\\\'");
    // Cut short, a byte that nothing begins with, and one that none goes on with.
    CHECK(shell_word("\xd1") == "$'\\xd1'");
    CHECK(shell_word("\x80") == "$'\\x80'");
    CHECK(shell_word("\xe7\xb6z") == "$'\\xe7\\xb6z'");
}

TEST_CASE("a command is one line") {
    const std::vector<std::string> arguments = {"report", "my mesh.ply", "-n", "100"};
    CHECK(command_text("geodisk", arguments) == "geodisk report 'my mesh.ply' -n 100");
    CHECK(command_text("geodisk", {}) == "geodisk");
}

} // namespace geodisk::tools
