// Runs the programs and catches what they say.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "unit/test_files.hpp"

namespace geodisk::test {

using tools::bytes_of;
using tools::contains;
using tools::lines_of;
using tools::TemporaryFolder;

using Arguments = std::vector<std::string>;

Arguments joined(Arguments arguments, const Arguments& more);

struct Outcome {
    int status = -1; ///< Exit status, or minus the signal that ended the program.
    std::string out;
    std::string err;
};

/// Circumstances of a run beyond its arguments.
struct Setting {
    std::string program = GEODISK_COMMAND;
    std::vector<std::pair<std::string, std::string>> environment; ///< Added to that of the tests.
    std::optional<std::size_t> file_size_limit;
    std::string folder;      ///< To run in, below that of the test.
    std::string stdin_path;  ///< A file to read standard input from.
    std::string stdout_path; ///< A file to append standard output to instead of a pipe.
    bool stdout_has_reader = true;
    std::vector<int> closed; ///< Numbers of streams that are closed.

    /// Standard error is a terminal; once it shows `signal_at`, the program gets `signal`.
    bool has_terminal = false;
    std::string signal_at;
    int signal = 0;
};

/// Runs the program, `geodisk` unless `setting` names another, in `folder` with the given
/// arguments.
Outcome run(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
            const Setting& setting = {});

/// Returns true if `has_terminal` can be had: a chroot without devpts has no terminals.
bool terminals_work();

std::vector<std::string> files_in(const TemporaryFolder& folder);

/// Checks that the run fails with `status`, one line on standard error that contains `part`,
/// nothing on standard output, and no new file.
void check_fails(const TemporaryFolder& folder, int status, const std::string& part,
                 const std::vector<std::string>& arguments, const Setting& setting = {});

} // namespace geodisk::test
