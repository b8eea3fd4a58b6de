// A Result that is asked for what it does not hold.
#include <csignal>
#include <string>
#include <vector>

#include <geodisk/status.hpp>

#include <doctest/doctest.h>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>

namespace {

/// Returns what a process that runs `misuse` prints before it aborts.
template <class Misuse>
std::string last_words(const Misuse& misuse) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGABRT, SIG_DFL);
        dup2(ends[1], STDERR_FILENO);
        misuse();
        _exit(0);
    }
    close(ends[1]);
    std::string words;
    char bytes[256];
    for (ssize_t count; (count = read(ends[0], bytes, sizeof bytes)) > 0;) {
        words.append(bytes, static_cast<std::size_t>(count));
    }
    close(ends[0]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGABRT);
    return words;
}

} // namespace

TEST_CASE("a result that holds something else ends the program with a message") {
    using Result = geodisk::Result<int>;
    const std::vector<Result> results{geodisk::Error{geodisk::Status::internal, "no disk"}, 1};
    CHECK(last_words([&] { *results[0]; }) == "geodisk: Result::value() of an error: no disk\n");
    CHECK(last_words([&] { results[1].error(); }) == "geodisk: Result::error() of a value\n");
}
#endif
