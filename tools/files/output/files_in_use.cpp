#include "files/output/files_in_use.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "files/file_identity.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/named_files.hpp"
#include "files/stream_path.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

bool is_there(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(Path(path), ignored);
}

} // namespace

void FilesInUse::add_read(const NamedFile& file) {
    if (file.path.empty() || is_builtin(file.path)) {
        return;
    }
    const auto [other, is_new] = read_.emplace(file_identity(file.path, 0), file);
    if (!is_new && input_stream(file.path) && !other->first.empty()) {
        fail_usage(file.path + ": a stream can be read only once, but " + other->second.what +
                   " and " + file.what + " both read it");
    }
    unopened_.push_back(file);
}

void FilesInUse::add_written(const NamedFile& file) {
    if (is_there(file.path)) { // Otherwise a mesh may name it, but nothing is lost.
        add_named_files();
    }
    add_appended(file);
}

void FilesInUse::add_appended(const NamedFile& file) {
    const std::string identity = file.path.empty() ? "" : file_identity(file.path);
    if (identity.empty()) {
        return;
    }
    const auto check = [&](const std::map<std::string, NamedFile>& files) {
        if (const auto other = files.find(identity); other != files.end()) {
            fail_usage(
                (file.path == "-" ? "standard output" : file.path) + ": " + file.what +
                (output_stream(file.path) ? " would go to the same place as " : " would replace ") +
                other->second.what);
        }
    };
    check(read_);
    check(written_);
    written_.emplace(identity, file);
}

void FilesInUse::add_named_files() {
    for (const NamedFile& file : std::exchange(unopened_, {})) {
        for (const Path& named : files_named_in(file.path, file.format)) {
            read_.emplace(file_identity(named),
                          NamedFile{"a file that " + file.path + " names", named.string()});
        }
    }
}

} // namespace geodisk::tools
