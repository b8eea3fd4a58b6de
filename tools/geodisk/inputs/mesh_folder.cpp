#include "geodisk/inputs/mesh_folder.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

bool is_hidden(const std::filesystem::path& path) {
    return path.filename().string().starts_with('.');
}

} // namespace

bool is_mesh_file(const std::filesystem::path& path) {
    static const std::vector<std::string> kExtensions = mesh_extensions();
    return std::ranges::find(kExtensions, lower_extension(path)) != kExtensions.end();
}

std::vector<std::filesystem::path> mesh_files_in(const Path& folder, const Path& without) {
    std::vector<std::filesystem::path> files;
    std::error_code error, ignored;
    std::filesystem::recursive_directory_iterator at(folder, error);
    for (; !error && at != std::filesystem::recursive_directory_iterator(); at.increment(error)) {
        check_interrupted();
        if (at->is_directory(ignored)) {
            if (is_hidden(at->path()) ||
                std::filesystem::equivalent(at->path(), without, ignored)) {
                at.disable_recursion_pending();
            }
        } else if (!is_hidden(at->path()) && is_mesh_file(at->path())) {
            files.push_back(at->path().lexically_relative(folder));
        }
    }
    if (error) {
        fail_input(folder, "cannot read the folder: " + error.message());
    }
    std::ranges::sort(files, {}, [](const auto& path) { return path.generic_string(); });
    return files;
}

} // namespace geodisk::tools
