#include "files/output/output_file.hpp"

#include "test_files.hpp"

#ifndef _WIN32
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace geodisk::tools;

TEST_CASE("a committed file replaces the old one") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.write("out.json", "old");
    {
        AtomicFile file(target);
        file.write("new ");
        file.write("text");
        CHECK(bytes_of(target) == "old");
        file.commit();
    }
    CHECK(bytes_of(target) == "new text");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("a file without commit leaves no trace") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.write("out.json", "old");
    {
        AtomicFile file(target);
        file.write("new");
    }
    CHECK(bytes_of(target) == "old");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("two writers of one target do not disturb each other") {
    const TemporaryFolder folder;
    AtomicFile first(folder / "out");
    AtomicFile second(folder / "out");
    first.write("first");
    second.write("second");
    second.commit();
    first.commit();
    CHECK(bytes_of(folder / "out") == "first");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("targets that cannot be files are refused") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder");
    check_fails(ExitCode::bad_output, "is a folder", [&] { AtomicFile file(folder / "folder"); });
    check_fails(ExitCode::bad_output, "No such file",
                [&] { AtomicFile file(folder / "missing" / "out"); });
}

#ifndef _WIN32

TEST_CASE("a file keeps its rights") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.write("secret", "old");
    using std::filesystem::perms;
    constexpr perms kOwn = perms::owner_read | perms::owner_write;
    std::filesystem::permissions(target, kOwn);
    AtomicFile file(target);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
        CHECK(entry.status().permissions() == kOwn); // The temporary one as well.
    }
    file.write("new");
    file.commit();
    CHECK(bytes_of(target) == "new");
    CHECK(std::filesystem::status(target).permissions() == kOwn);
}

TEST_CASE("files that are write-protected or have other names are refused") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.write("one", "old");
    std::filesystem::create_hard_link(target, folder / "two");
    check_fails(ExitCode::bad_output, "one: cannot write: has another name (a hard link)",
                [&] { AtomicFile file(target); });
    std::filesystem::remove(folder / "two");
    if (geteuid() != 0) { // Who may write to everything.
        std::filesystem::permissions(target, std::filesystem::perms::owner_read);
        check_fails(ExitCode::bad_output, "one: cannot write: is write-protected",
                    [&] { AtomicFile file(target); });
    }
    CHECK(folder.file_count() == 1);
}

TEST_CASE("a name may be as long as names can be") {
    const TemporaryFolder folder;
    AtomicFile file(folder / std::string(255, 'x'));
    file.commit();
    CHECK(folder.file_count() == 1);
}

TEST_CASE("the file of a process that was killed goes with the next, that of a live one stays") {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
        AtomicFile file(folder / "out");
        file.write("half");
        file.sync();
        _exit(0); // As a kill would, without destructors.
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(folder.file_count() == 1);
    const AtomicFile live(folder / "out");
    CHECK(folder.file_count() == 1);
    AtomicFile next(folder / "out");
    CHECK(folder.file_count() == 2);
    next.commit();
    CHECK(folder.file_count() == 2);
    CHECK(bytes_of(folder / "out").empty());
}

TEST_CASE("temporary files that are noted can all be removed") {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
        const AtomicFile one(folder / "one"), two(folder / "two");
        remove_noted_temporaries();
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(folder.file_count() == 0);
}

TEST_CASE("a stream gets all bytes at once, behind what is there") {
    const TemporaryFolder folder;
    const std::filesystem::path log = folder.write("log", "kept\n");
    const int descriptor = open(log.c_str(), O_WRONLY | O_APPEND);
    const std::string name = "/dev/fd/" + std::to_string(descriptor);
    std::filesystem::create_symlink(name, folder / "link");
    for (const std::filesystem::path& path : {std::filesystem::path(name), folder / "link"}) {
        AtomicFile file(path);
        file.write("more ");
        file.write("text\n");
        file.sync();
        CHECK_FALSE(contains(bytes_of(log), path == name ? "more" : "text\nmore"));
        file.commit();
    }
    CHECK(bytes_of(log) == "kept\nmore text\nmore text\n");
    close(descriptor);
    CHECK(folder.file_count() == 2);
    check_fails(ExitCode::bad_output, "is not open for writing", [&] { AtomicFile file(name); });
    const int read_only = open(log.c_str(), O_RDONLY);
    check_fails(ExitCode::bad_output, "is not open for writing",
                [&] { AtomicFile file("/dev/fd/" + std::to_string(read_only)); });
    close(read_only);
}

TEST_CASE("a pipe is written to, and ends in silence when nobody reads it any more") {
    const TemporaryFolder folder;
    const std::filesystem::path pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    AtomicFile file(pipe);
    file.write("text");
    file.commit();
    char bytes[8] = {};
    CHECK(read(reader, bytes, sizeof bytes) == 4);
    CHECK(std::string(bytes) == "text");
    const int writer = open(pipe.c_str(), O_WRONLY);
    close(reader);
    std::signal(SIGPIPE, SIG_IGN); // As programs do.
    AtomicFile unread("/dev/fd/" + std::to_string(writer));
    unread.write("text");
    const auto error = error_of([&] { unread.commit(); });
    REQUIRE(error);
    CHECK(error->code() == ExitCode::bad_output);
    CHECK(std::string(error->what()).empty());
    close(writer);
}

TEST_CASE("a claimed name replaces nothing and goes without commit") {
    const TemporaryFolder folder;
    folder.write("taken", "old");
    std::filesystem::create_symlink("nowhere", folder / "dangling");
    {
        AtomicFile file(folder / "first");
        file.write("new");
        CHECK_FALSE(file.claim(folder / "taken"));
        CHECK_FALSE(file.claim(folder / "dangling"));
        REQUIRE(file.claim(folder / "free"));
        CHECK(bytes_of(folder / "free") == "new");
        AtomicFile second(folder / "first");
        CHECK_FALSE(second.claim(folder / "free"));
    }
    CHECK(folder.file_count() == 2);
    AtomicFile file(folder / "first");
    file.write("new");
    REQUIRE(file.claim(folder / "given"));
    file.release();
    REQUIRE(file.claim(folder / "free"));
    file.commit();
    CHECK(bytes_of(folder / "free") == "new");
    CHECK(bytes_of(folder / "taken") == "old");
    CHECK(folder.file_count() == 3);
}

TEST_CASE("devices and links are not replaced") {
    {
        AtomicFile file("/dev/null");
        CHECK(file.stream());
        file.write("new");
        file.commit();
    }
    CHECK(std::filesystem::is_character_file("/dev/null"));
    const TemporaryFolder folder;
    folder.write("real", "old");
    std::filesystem::create_symlink("real", folder / "link");
    AtomicFile file(folder / "link");
    file.write("new");
    file.commit();
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(bytes_of(folder / "real") == "new");
    // Also where there is nothing yet that the link leads to.
    std::filesystem::create_symlink("later", folder / "dangling");
    AtomicFile(folder / "dangling").commit();
    CHECK(std::filesystem::is_symlink(folder / "dangling"));
    CHECK(std::filesystem::is_regular_file(folder / "later"));
    std::filesystem::create_symlink("circle", folder / "circle");
    check_fails(ExitCode::bad_output, "circle: cannot write: is a broken symbolic link",
                [&] { AtomicFile circle(folder / "circle"); });
}

namespace {

/// Makes every write past `bytes` of a file fail while it lives, as a full disk would.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit old_limit_{};
    void (*old_handler_)(int);
};

} // namespace

TEST_CASE("a write that fails leaves the old file and no temporary one") {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder.write("out.json", "old");
    // Far past the buffer the failure comes from write(), below it from commit().
    for (const std::size_t size : {std::size_t{1} << 20, std::size_t{100}}) {
        std::optional<UserError> error;
        {
            const FileSizeLimit limit(64);
            error = error_of([&] {
                AtomicFile file(target);
                file.write(std::string(size, 'x'));
                file.commit();
            });
        }
        REQUIRE(error.has_value());
        CHECK(error->code() == ExitCode::bad_output);
        CHECK(contains(error->what(), "out.json: cannot write: File too large"));
        CHECK(bytes_of(target) == "old");
        CHECK(folder.file_count() == 1);
    }
}

#endif
