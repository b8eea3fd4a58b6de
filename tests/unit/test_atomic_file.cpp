#include "files/output_file.hpp"

#include "test_files.hpp"

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
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

TEST_CASE("devices and links are not replaced") {
    check_fails(ExitCode::bad_output, "not a regular file", [] { AtomicFile file("/dev/null"); });
    const TemporaryFolder folder;
    folder.write("real", "old");
    std::filesystem::create_symlink("real", folder / "link");
    AtomicFile file(folder / "link");
    file.write("new");
    file.commit();
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(bytes_of(folder / "real") == "new");
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
