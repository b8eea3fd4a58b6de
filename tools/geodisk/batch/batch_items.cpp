#include "geodisk/batch/batch_items.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/input_file.hpp"
#include "files/mesh_file.hpp"
#include "files/name_case.hpp"
#include "files/sample_target.hpp"
#include "geodisk/inputs/manifest.hpp"
#include "geodisk/inputs/mesh_folder.hpp"
#include "geodisk/options/sample_command.hpp"
#include "geodisk/sample_run.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Whether `path` stays in the folder that it is relative to, and names something there.
bool stays_inside(const std::filesystem::path& path) {
    return path.is_relative() && path.has_filename() &&
           std::ranges::none_of(path, [](const auto& part) { return part == ".." || part == "."; });
}

/// The name in DIR of the samples of `mesh`, a path as given, without extension.
std::filesystem::path name_of(const std::string& mesh) {
    if (is_builtin(mesh)) {
        std::string name = mesh.substr(mesh.find(':') + 1);
        std::ranges::replace(name, ':', '-'); // Which no file of Windows may have in its name.
        return Path(name);
    }
    std::filesystem::path name = Path(mesh).lexically_normal();
    if (!stays_inside(name)) {
        name = name.filename();
    }
    return name.replace_extension();
}

/// As given with -o, with the extension of a format.
std::filesystem::path given_name(const std::string& name, const std::string& format) {
    Path path(name);
    if (!stays_inside(path)) {
        fail_usage("--output: " + in_quotes(name) + " is no name of a file inside the folder");
    }
    const std::string extension = lower_extension(path);
    const bool has_format =
        !extension.empty() && is_sample_format(std::string_view(extension).substr(1));
    if (!has_format) {
        path += '.' + format;
    }
    return path;
}

BatchItem make_item(SampleOptions options, const BatchOptions& batch,
                    const std::filesystem::path& name, std::string place) {
    options.out.output = (Path(batch.folder) / name).string();
    return {parse_job(options), sample_command(options), std::move(place)};
}

std::vector<BatchItem> items_in_folder(const BatchOptions& batch) {
    std::vector<BatchItem> items;
    for (const std::filesystem::path& file : mesh_files_in(batch.input, batch.folder)) {
        SampleOptions options = batch.sample;
        options.mesh.mesh = (Path(batch.input) / file).string();
        std::filesystem::path name = file;
        name.replace_extension('.' + batch.format);
        items.push_back(make_item(options, batch, name, options.mesh.mesh));
    }
    return items;
}

BatchItem item_of_line(const std::vector<std::string>& words, const BatchOptions& batch,
                       const std::string& place) {
    LineOptions line = parse_line(batch.sample, words, Path(batch.input).parent_path());
    std::filesystem::path name;
    if (line.name.empty()) {
        name = name_of(line.mesh);
        name += '.' + batch.format;
    } else {
        name = given_name(line.name, batch.format);
    }
    return make_item(std::move(line.sample), batch, name, place);
}

std::vector<BatchItem> items_in_manifest(const BatchOptions& batch) {
    std::vector<BatchItem> items;
    for (const ManifestLine& line : read_manifest(batch.input)) {
        const std::string place = line_text(batch.input, line.number);
        try {
            items.push_back(item_of_line(line.words, batch, place));
        } catch (const UserError& error) {
            throw UserError(error.code(), place + ": " + error.what());
        }
    }
    return items;
}

/// What is the same for two paths to one file, be it there or not.
std::string identity(const std::string& path, bool one_case) {
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::absolute(Path(path), ignored);
    const std::filesystem::path found = std::filesystem::weakly_canonical(whole, ignored);
    const std::u8string text = (found.empty() ? whole.lexically_normal() : found).u8string();
    std::string name(text.begin(), text.end());
    return one_case ? lower_case(std::move(name)) : name;
}

/// Each file in `folder` is written once, and none is written that is read.
void check_files(const std::vector<BatchItem>& items, const std::string& folder) {
    const bool one_case = ignores_case(Path(folder));
    std::map<std::string, const BatchItem*> written;
    for (const BatchItem& item : items) {
        const auto [other, is_new] =
            written.emplace(identity(item.job.out.output, one_case), &item);
        if (!is_new) {
            fail_usage(other->second->place + " and " + item.place + " would both write " +
                       item.job.out.output + "; a line of a manifest gives another name by -o");
        }
    }
    for (const BatchItem& item : items) {
        for (const NamedFile& file : files_read(item.job)) {
            if (is_builtin(file.path)) {
                continue;
            }
            const auto writer = written.find(identity(file.path, one_case));
            if (writer != written.end()) {
                fail_usage(writer->second->place + ": its samples would replace " + file.path +
                           "; give another folder");
            }
        }
    }
}

} // namespace

std::vector<BatchItem> batch_items(const BatchOptions& options) {
    sample_target(options.input, options.format); // Fails for what is no format.
    std::error_code ignored;
    const bool is_folder = std::filesystem::is_directory(Path(options.input), ignored);
    std::vector<BatchItem> items =
        is_folder ? items_in_folder(options) : items_in_manifest(options);
    if (items.empty()) {
        fail_input(options.input,
                   is_folder ? "holds no mesh (*.gltf, *.glb, *.obj, *.off, *.ply or *.stl)"
                             : "names no mesh");
    }
    check_files(items, options.folder);
    return items;
}

} // namespace geodisk::tools
