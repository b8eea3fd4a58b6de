#include "files/output/line_log.hpp"

#include "test_files.hpp"

using namespace geodisk::tools;

TEST_CASE("a log grows by whole lines, and loses one that a killed program has torn") {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "log";
    { LineLog(path).append("one"); }
    CHECK(bytes_of(path) == "one\n");
    folder.write("log", "one\ntwo\nthr");
    {
        LineLog log(path);
        log.append("three");
        CHECK(bytes_of(path) == "one\ntwo\nthree\n"); // Before it is closed.
        log.append("four");
    }
    CHECK(bytes_of(path) == "one\ntwo\nthree\nfour\n");
    folder.write("log", "torn");
    { const LineLog log(path); }
    CHECK(bytes_of(path).empty());
}

TEST_CASE("a log is of one program at a time, and must be writable") {
    const TemporaryFolder folder;
    const LineLog log(folder / "log");
    check_fails(ExitCode::bad_output, "another program is writing it",
                [&] { const LineLog other(folder / "log"); });
    check_fails(ExitCode::bad_output, "cannot write", [&] { const LineLog other(folder / ""); });
    check_fails(ExitCode::bad_output, "cannot write",
                [&] { const LineLog other(folder / "absent/log"); });
}
