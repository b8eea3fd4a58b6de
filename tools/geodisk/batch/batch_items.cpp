#include "geodisk/batch/batch_items.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/file_identity.hpp"
#include "files/input_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/output/files_in_use.hpp"
#include "files/samples/sample_format.hpp"
#include "files/samples/told_samples.hpp"
#include "geodisk/inputs/manifest.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/sample_run.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

bool is_hidden(const std::filesystem::path& path) {
    return path.filename().string().starts_with('.');
}

/// Returns true if the file is to be read as a mesh: by its extension, or as a binary surface of
/// FreeSurfer.
bool is_mesh_file(const std::filesystem::path& path) {
    const std::vector<std::string> extensions = mesh_extensions();
    return std::ranges::find(extensions, lower_extension(path)) != extensions.end() ||
           begins_as_freesurfer(path);
}

/// Returns the endings of names that only meshes have, behind `before`: ".obj", ".surf.gii".
std::vector<std::string> mesh_endings(const std::string& before = ".") {
    std::vector<std::string> endings = mesh_extensions(before);
    std::erase(endings, before + "asc"); // Tables and maps have it too.
    std::ranges::replace(endings, before + "gii", before + "surf.gii");
    return endings;
}

/// Returns true if a folder of meshes may have `path` for one of them.
bool is_mesh_in_folder(const std::filesystem::path& path) {
    static const std::vector<std::string> kEndings = mesh_endings();
    const std::string name = lower_case(path.filename().string());
    return std::ranges::any_of(kEndings,
                               [&](const std::string& ending) { return name.ends_with(ending); });
}

/// Relative paths of all files in `folder`, and in folders in it, that have one of mesh_endings(),
/// in the order of their names. What begins with a dot is passed over, and so is the folder
/// `without`, where results may be. Throws UserError(bad_input) for a folder that cannot be read.
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

/// Returns true if `path` stays in the folder that it is relative to, and names something there.
bool stays_inside(const std::filesystem::path& path) {
    return path.is_relative() && path.has_filename() &&
           std::ranges::none_of(path, [](const auto& part) { return part == ".." || part == "."; });
}

/// The name in DIR of the samples of `mesh`, a path as given.
std::filesystem::path name_of(const std::string& mesh, const BatchOptions& batch) {
    if (is_builtin(mesh)) {
        std::string name = mesh.substr(mesh.find(':') + 1);
        std::ranges::replace(name, ':', '-'); // Which no file of Windows may have in its name.
        return Path(name + '.' + batch.format);
    }
    std::filesystem::path name = Path(mesh).lexically_normal();
    if (!stays_inside(name)) {
        name = name.filename();
    }
    if (!batch.keeps_extensions) {
        name.replace_extension();
    }
    return name += '.' + batch.format;
}

/// As given with -o, with the extension of a format.
std::filesystem::path given_name(const std::string& name, const std::string& format) {
    Path path(name);
    if (!stays_inside(path)) {
        fail_usage("--output: " + in_quotes(name) + " is not a file name inside the folder");
    }
    if (!find_format(path)) {
        path += '.' + format;
    }
    return path;
}

/// The name of a file from any folder: links to folders are followed, that of the file is kept.
std::string from_anywhere(const std::string& path) {
    if (path.empty() || path == "-" || is_builtin(path)) {
        return path;
    }
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::absolute(Path(path), ignored);
    const std::filesystem::path folder =
        std::filesystem::weakly_canonical(whole.parent_path(), ignored);
    const std::u8string text =
        (folder.empty() ? whole : folder / whole.filename()).generic_u8string();
    return {text.begin(), text.end()};
}

/// The same job with names of files from any folder.
SampleOptions from_anywhere(SampleOptions options) {
    place_files(options, [](const std::string& file) { return from_anywhere(file); });
    options.out.output = from_anywhere(options.out.output);
    return options;
}

BatchItem make_item(SampleOptions options, const BatchOptions& batch,
                    const std::filesystem::path& name, std::string place) {
    options.out.output = (Path(batch.folder) / name).string();
    return {parse_job(options), sample_command(from_anywhere(options)), std::move(place), {}};
}

/// The mesh with the options of all; its samples are named by `given`.
BatchItem item_of_mesh(const BatchOptions& batch, const std::string& mesh,
                       const std::string& given) {
    SampleOptions options = batch.sample;
    options.mesh.mesh = mesh;
    return make_item(std::move(options), batch, name_of(given, batch), mesh);
}

std::vector<BatchItem> items_in_folder(const BatchOptions& batch, const Path& folder) {
    std::vector<BatchItem> items;
    std::vector<std::string> skipped;
    for (const std::filesystem::path& file : mesh_files_in(folder, batch.folder)) {
        const Path path = folder / file;
        if (begins_as_samples(path)) {
            skipped.push_back(path.string());
        } else {
            items.push_back(item_of_mesh(batch, path.string(), file.string()));
        }
    }
    if (!skipped.empty()) {
        print_warning(folder.string() + ": " + counted(skipped.size(), "file holds", "files hold") +
                      " samples, not a mesh, and " + (skipped.size() == 1 ? "is" : "are") +
                      " skipped: " + skipped.front() + (skipped.size() > 1 ? ", ..." : ""));
    }
    if (items.empty()) {
        fail_input(folder, "holds no mesh (" + listed(mesh_endings("*."), " or ") + ")");
    }
    return items;
}

BatchItem item_of_line(const std::vector<std::string>& words, const BatchOptions& batch,
                       const Path& manifest, const std::string& place) {
    LineOptions line = parse_line(batch.sample, words, manifest.parent_path());
    const std::filesystem::path name =
        line.name.empty() ? name_of(line.mesh, batch) : given_name(line.name, batch.format);
    return make_item(std::move(line.sample), batch, name, place);
}

std::vector<BatchItem> items_in_manifest(const BatchOptions& batch, const Path& manifest) {
    std::vector<BatchItem> items;
    for (const ManifestLine& line : read_manifest(manifest)) {
        const std::string place = line_text(manifest, line.number);
        try {
            items.push_back(item_of_line(line.words, batch, manifest, place));
        } catch (const UserError& error) {
            throw UserError(error.code(), place + ": " + error.what());
        }
    }
    if (items.empty()) {
        fail_input(manifest, "names no mesh");
    }
    return items;
}

bool is_folder(const std::string& input) {
    std::error_code ignored;
    return std::filesystem::is_directory(Path(input), ignored);
}

bool is_mesh(const std::string& input) {
    return is_builtin(input) || (!is_folder(input) && is_mesh_file(Path(input)));
}

std::vector<BatchItem> items_of(const BatchOptions& batch, const std::string& input) {
    if (is_mesh(input)) {
        return {item_of_mesh(batch, input, input)};
    }
    if (is_folder(input)) {
        return items_in_folder(batch, input);
    }
    if (holds_samples(input)) {
        fail_input(input, "holds samples, but a mesh, a folder or a manifest is expected here");
    }
    return items_in_manifest(batch, input);
}

/// Marks items that would write the same file: none of them has a better right to it.
void find_clashes(std::vector<BatchItem>& items) {
    std::map<std::string, BatchItem*> writers;
    for (BatchItem& item : items) {
        const auto [other, is_new] = writers.emplace(file_identity(item.job.out.output), &item);
        if (!is_new) {
            item.fault = other->second->place + " and " + item.place + " would both write " +
                         item.job.out.output +
                         "; give --keep-extensions, or another name by -o in a manifest";
            other->second->fault = item.fault;
        }
    }
}

} // namespace

std::vector<BatchItem> batch_items(const BatchOptions& options) {
    sample_target(options.inputs.front(), options.format); // Fails for what is no format.
    std::vector<BatchItem> items;
    for (const std::string& input : options.inputs) {
        std::vector<BatchItem> more = items_of(options, input);
        std::ranges::move(more, std::back_inserter(items));
    }
    find_clashes(items);
    return items;
}

void check_batch_files(const BatchOptions& options, const std::vector<BatchItem>& items,
                       const std::string& log, const std::set<std::string>& done) {
    FilesInUse files;
    for (const std::string& input : options.inputs) {
        if (!is_folder(input) && !is_mesh(input)) {
            files.add_read({"the manifest", input});
        }
    }
    for (const BatchItem& item : items) {
        for (const NamedFile& file : files_read(item.job)) {
            files.add_read(file);
        }
    }
    for (const BatchItem& item : items) {
        const NamedFile samples{"the samples of " + item.place, item.job.out.output};
        if (done.contains(item.command)) {
            files.add_read(samples);
        } else if (item.fault.empty()) {
            files.add_written(samples);
        }
    }
    files.add_appended({"the log", log});
    files.add_written({"the report", options.sample.out.json});
}

} // namespace geodisk::tools
