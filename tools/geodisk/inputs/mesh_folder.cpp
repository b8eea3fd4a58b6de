#include "geodisk/inputs/mesh_folder.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

bool is_hidden(const std::filesystem::path& path) {
    return path.filename().string().starts_with('.');
}

/// Returns true if a folder of meshes may have `path` for one of them.
bool is_mesh_in_folder(const std::filesystem::path& path) {
    static const std::vector<std::string> kEndings = mesh_endings();
    const std::string name = lower_case(path.filename().string());
    return std::ranges::any_of(kEndings,
                               [&](const std::string& ending) { return name.ends_with(ending); });
}

} // namespace

bool is_mesh_file(const std::filesystem::path& path) {
    const std::vector<std::string> extensions = mesh_extensions();
    return std::ranges::find(extensions, lower_extension(path)) != extensions.end() ||
           begins_as_freesurfer(path);
}

std::vector<std::string> mesh_endings(const std::string& before) {
    std::vector<std::string> endings = mesh_extensions(before);
    std::erase(endings, before + "asc"); // Tables and maps have it too.
    std::ranges::replace(endings, before + "gii", before + "surf.gii");
    return endings;
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
        } else if (!is_hidden(at->path()) && is_mesh_in_folder(at->path())) {
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
