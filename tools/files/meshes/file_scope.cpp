#include "files/meshes/file_scope.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/name_text.hpp"
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

bool is_there(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

std::string utf8_of(const std::filesystem::path& path) {
    const std::u8string text = path.generic_u8string();
    return {text.begin(), text.end()};
}

/// Returns true for a name of another machine: with a drive, or from a root that has no such file.
bool is_foreign(const std::string& name) {
    const bool has_drive = name.size() > 2 && name[1] == ':' && (name[2] == '\\' || name[2] == '/');
    const Path path = named_path({}, name);
    return has_drive || (path.has_root_path() && !is_there(path));
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

std::vector<std::string> names_in_folder(const Path& folder) {
    std::error_code error;
    std::vector<std::string> names;
    for (std::filesystem::directory_iterator entry(folder.empty() ? Path(".") : folder, error), end;
         !error && entry != end; entry.increment(error)) {
        names.push_back(utf8_of(entry->path().filename()));
    }
    std::ranges::sort(names);
    return names;
}

Path path_like(const Path& folder, const std::string& name) {
    Path path = folder;
    for (const std::filesystem::path& part : named_path({}, name)) {
        Path next = path / part;
        if (!is_there(next)) {
            const std::string wanted = folded_name(utf8_of(part));
            const std::vector<std::string> names = names_in_folder(path);
            const auto like = std::ranges::find(names, wanted, folded_name);
            next = like == names.end() ? next : Path(path / Path(*like));
        }
        path = std::move(next);
    }
    return path;
}

void note_name(const std::string& what, const FoundFile& found,
               std::vector<MeshWarning>& warnings) {
    if (!found.note.empty()) {
        warnings.push_back({"other_file_name", 1, "", what + ' ' + found.note, {}});
    }
}

FoundFile FileScope::find(const Path& from, const std::string& name) const {
    FoundFile found{{}, refusal(from, name), {}};
    if (input_stream(mesh_)) {
        return found;
    }
    const Path folder = from.parent_path();
    if (found.refusal.empty()) {
        const Path exact = named_path(from, name);
        found.file = is_there(exact) ? exact : path_like(folder, name);
        if (!is_there(found.file)) {
            found.file.clear();
        } else if (found.file != exact) {
            found.refusal = link_refusal(found.file, name);
        }
    }
    if (found.file.empty() && (found.refusal.empty() || is_foreign(name))) {
        const Path beside = path_like(folder, utf8_of(named_path({}, name).filename()));
        const bool is_file = is_there(beside) && beside != folder;
        found = is_file ? FoundFile{beside, link_refusal(beside, name), {}} : found;
    }
    if (!found.refusal.empty()) {
        found.file.clear();
    } else if (!found.file.empty() && found.file != named_path(from, name)) {
        found.note = in_quotes(readable_name(name)) + " is read as " + utf8_of(found.file);
    }
    return found;
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
    return link_refusal(named_path(from, name), name);
}

std::string FileScope::link_refusal(const Path& named, const std::string& name) const {
    if (allows_outside_) {
        return {};
    }
    std::error_code error;
    const Path folder = mesh_.has_parent_path() ? mesh_.parent_path() : Path(".");
    const Path file = std::filesystem::canonical(named, error);
    if (error || is_below(std::filesystem::canonical(folder, error), file)) {
        return {};
    }
    return in_quotes(name) + " leads to " + file.string() + ", which" + kOutside;
}

} // namespace geodisk::tools
