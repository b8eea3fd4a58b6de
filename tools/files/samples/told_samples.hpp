// Samples in the place of a mesh, which are an easy mistake.
#pragma once

#include <string>

#include "program/failure.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// What is wrong with them.
inline constexpr const char* kHoldsSamples = "holds samples, but a mesh is expected here";

/// Returns true if a PLY, OBJ or glTF file begins as those that geodisk writes of samples. Reads
/// its first bytes alone; false for what cannot be read.
bool begins_as_samples(const Path& path);

/// Returns true if a file holds samples, which begins_as_samples() says or read_samples().
bool holds_samples(const Path& path);

/// Returns `read()`. Where that throws UserError(bad_input), and `path` holds samples, throws one
/// that says so, and then `hint` unless it is "".
template <class Read>
auto read_unless_samples(const Path& path, const std::string& hint, const Read& read) {
    try {
        return read();
    } catch (const UserError& error) {
        if (error.code() == ExitCode::bad_input && holds_samples(path)) {
            fail_input(path, kHoldsSamples + (hint.empty() ? "" : "; " + hint));
        }
        throw;
    }
}

} // namespace geodisk::tools
