#include "cli/command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace geodisk::test {
namespace {

/// Both ends of a pipe or terminal; the reader is ours.
struct Channel {
    int reader = -1;
    int writer = -1;
};

Channel open_terminal() {
    Channel terminal;
    terminal.reader = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal.reader >= 0 && grantpt(terminal.reader) == 0 && unlockpt(terminal.reader) == 0) {
        terminal.writer = open(ptsname(terminal.reader), O_RDWR | O_NOCTTY | O_CLOEXEC);
    }
    return terminal;
}

Channel open_channel(bool is_terminal) {
    Channel channel;
    if (is_terminal) {
        channel = open_terminal();
    } else if (int ends[2]; pipe(ends) == 0) {
        channel = {ends[0], ends[1]};
    }
    if (channel.writer < 0) {
        throw std::runtime_error("the test cannot open a pipe or terminal");
    }
    return channel;
}

/// In the child: never returns.
[[noreturn]] void execute(const TemporaryFolder& folder, std::vector<std::string> arguments,
                          const Setting& setting, int out, int err) {
    arguments.insert(arguments.begin(), setting.program);
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    for (const auto& [name, value] : setting.environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    if (!setting.stdout_path.empty()) {
        out = open(setting.stdout_path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    }
    if (!setting.stdin_path.empty()) {
        dup2(open(setting.stdin_path.c_str(), O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    }
    if (setting.file_size_limit) {
        const rlimit limit{*setting.file_size_limit, *setting.file_size_limit};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    // Whoever starts the tests may ignore signals, which programs then go on to do.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) {
        std::signal(signal, SIG_DFL);
    }
    if (chdir((folder / setting.folder).c_str()) == 0 && dup2(out, STDOUT_FILENO) >= 0 &&
        dup2(err, STDERR_FILENO) >= 0) {
        for (const int stream : setting.closed) {
            close(stream);
        }
        execv(setting.program.c_str(), pointers.data());
    }
    _exit(127);
}

/// Reads what is there. False at the end; a terminal whose other side is closed reports an error.
bool read_some(int from, std::string& to) {
    char bytes[4096];
    const ssize_t count = read(from, bytes, sizeof bytes);
    if (count <= 0) {
        return count < 0 && errno == EINTR;
    }
    to.append(bytes, static_cast<std::size_t>(count));
    return true;
}

void collect(int out, int err, pid_t child, const Setting& setting, Outcome& outcome) {
    pollfd channels[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* const texts[2] = {&outcome.out, &outcome.err};
    bool has_signalled = setting.signal == 0;
    while (channels[0].fd >= 0 || channels[1].fd >= 0) {
        poll(channels, 2, -1);
        for (int i = 0; i < 2; ++i) {
            if (channels[i].fd >= 0 && channels[i].revents != 0 &&
                !read_some(channels[i].fd, *texts[i])) {
                channels[i].fd = -1;
            }
        }
        if (!has_signalled && contains(outcome.err, setting.signal_at)) {
            kill(child, setting.signal);
            has_signalled = true;
        }
    }
}

} // namespace

Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

Outcome run(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
            const Setting& setting) {
    const Channel out = open_channel(false);
    const Channel err = open_channel(setting.has_terminal);
    if (!setting.stdout_has_reader) {
        close(out.reader);
    }
    const pid_t child = fork();
    if (child == 0) {
        close(out.reader);
        close(err.reader);
        execute(folder, arguments, setting, out.writer, err.writer);
    }
    close(out.writer);
    close(err.writer);
    Outcome outcome;
    collect(setting.stdout_has_reader ? out.reader : -1, err.reader, child, setting, outcome);
    if (setting.stdout_has_reader) {
        close(out.reader);
    }
    close(err.reader);
    int status = 0;
    waitpid(child, &status, 0);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return outcome;
}

bool terminals_work() {
    const Channel terminal = open_terminal();
    close(terminal.writer);
    close(terminal.reader);
    return terminal.writer >= 0;
}

std::vector<std::string> files_in(const TemporaryFolder& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void check_fails(const TemporaryFolder& folder, int status, const std::string& part,
                 const std::vector<std::string>& arguments, const Setting& setting) {
    const std::string name = std::filesystem::path(setting.program).filename().string();
    std::string command = name;
    for (const std::string& argument : arguments) {
        command += " " + argument;
    }
    INFO(command);
    const std::vector<std::string> before = files_in(folder);
    const Outcome outcome = run(folder, arguments, setting);
    INFO(outcome.err);
    CHECK(outcome.status == status);
    CHECK(contains(outcome.err, part));
    CHECK(outcome.err.starts_with(name + ": "));
    CHECK(lines_of(outcome.err).size() == 1);
    CHECK(outcome.out.empty());
    CHECK(files_in(folder) == before);
}

} // namespace geodisk::test
