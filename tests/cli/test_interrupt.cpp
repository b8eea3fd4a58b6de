// Progress on a terminal, and stopping while it shows.
#include <doctest/doctest.h>

#include <csignal>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

bool lacks_terminals() {
    const bool lacks = !terminals_work();
    if (lacks) {
        MESSAGE("skipped: this system has no terminals, as where devpts is not mounted");
    }
    return lacks;
}

/// Long enough that nobody waits for its end.
const std::vector<std::string> kLongRun{
    "sample", "builtin:icosphere:5", "-o", "a.ply", "-n", "1000000", "--json", "a.json"};

void check_stops(int signal, int status, const char* message,
                 const std::vector<std::string>& arguments = kLongRun,
                 const char* signal_at = "sampling  [") {
    if (lacks_terminals()) {
        return;
    }
    const TemporaryFolder folder;
    Setting setting;
    setting.has_terminal = true;
    setting.signal_at = signal_at;
    setting.signal = signal;
    const Outcome outcome = run(folder, arguments, setting);
    CHECK(outcome.status == status);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.ends_with(message));
    CHECK(files_in(folder).empty());
}

} // namespace

TEST_CASE("SIGINT stops sampling") {
    check_stops(SIGINT, 130, "\rgeodisk: interrupted\r\n");
}

TEST_CASE("SIGTERM stops sampling") {
    check_stops(SIGTERM, 143, "\rgeodisk: terminated\r\n");
}

TEST_CASE("SIGHUP and SIGQUIT stop sampling") {
    check_stops(SIGHUP, 129, "\rgeodisk: hung up\r\n");
    check_stops(SIGQUIT, 131, "\rgeodisk: quit\r\n");
}

TEST_CASE("a stage that does not look for signals is stopped as well") {
    check_stops(SIGINT, 130, "\rgeodisk: interrupted\r\n",
                {"sample", "builtin:terrain:3000", "-o", "a.ply", "-n", "9"}, "reading");
}

TEST_CASE("progress leaves the terminal empty, and quiet shows none") {
    if (lacks_terminals()) {
        return;
    }
    const TemporaryFolder folder;
    Setting setting;
    setting.has_terminal = true;
    const Outcome outcome =
        run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-n", "9"}, setting);
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.err, "sampling"));
    CHECK(outcome.err.ends_with(" \r"));
    CHECK_FALSE(contains(outcome.err, "\n"));
    const Outcome quiet =
        run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-n", "9", "--quiet"}, setting);
    CHECK(quiet.status == 0);
    CHECK(quiet.err.empty());
    CHECK(quiet.out.empty());
}

} // namespace geodisk::test
