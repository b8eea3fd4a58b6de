#include "files/meshes/file_scope.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/stream_path.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kOutside =
    " is not a file of its folder, so it is not read; add --allow-outside if you trust the mesh";

/// Returns true for a path below a folder, as far as names tell.
bool stays_below(const std::filesystem::path& folder, const std::filesystem::path& path) {
    const std::filesystem::path rest =
        path.lexically_normal().lexically_relative(folder.lexically_normal());
    return !rest.empty() && *rest.begin() != "..";
}

bool is_below(const std::filesystem::path& folder, const std::filesystem::path& file) {
    return std::ranges::mismatch(folder, file).in1 == folder.end();
}

} // namespace

Path named_path(const Path& from, std::string name) {
    if (name.size() > 1 && name.starts_with('"') && name.ends_with('"')) {
        name = name.substr(1, name.size() - 2);
    }
    std::ranges::replace(name, '\\', '/'); // As Windows writes them.
    return from.parent_path() / Path(name);
}

FileScope::FileScope(Path mesh, bool allows_outside)
    : mesh_(std::move(mesh)), allows_outside_(allows_outside) {}

std::string FileScope::refusal(const Path& from, const std::string& name) const {
    if (input_stream(mesh_)) {
        return in_quotes(name) +
               " is not read, as a mesh from a stream has no folder; give the file of the mesh";
    }
    if (allows_outside_) {
        return {};
    }
    // A colon is of a drive or URL.
    const bool is_plain = name.find_first_of(std::string_view(":\0", 2)) == std::string::npos &&
                          !named_path({}, name).has_root_path();
    if (!is_plain || !stays_below(mesh_.parent_path(), named_path(from, name))) {
        return in_quotes(name) + kOutside;
    }
    std::error_code error;
    const Path folder = mesh_.has_parent_path() ? mesh_.parent_path() : Path(".");
    const Path file = std::filesystem::canonical(named_path(from, name), error);
    if (error || is_below(std::filesystem::canonical(folder, error), file)) {
        return {};
    }
    return in_quotes(name) + " leads to " + file.string() + ", which" + kOutside;
}

} // namespace geodisk::tools
