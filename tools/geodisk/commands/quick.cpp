#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "files/meshes/mesh_file.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/command.hpp"
#include "program/command_line.hpp"
#include "program/command_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "shapes/builtin_shapes.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kQuickExamples[] = {
    "geodisk bunny.obj",
    "geodisk bunny.obj --count 500 --seed 7",
    "geodisk bunny.obj teapot.ply --min-distance 2% --format csv",
};

bool exists(const Path& path) {
    std::error_code error;
    return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

/// "bunny-samples" of "meshes/bunny.obj".
std::string base_name(const std::string& mesh) {
    std::string name = mesh;
    if (mesh == "-") {
        name = "stdin";
    } else if (is_builtin(mesh)) {
        name.erase(0, mesh.find(':') + 1);
        std::replace(name.begin(), name.end(), ':', '-');
    } else {
        const std::u8string stem = Path(mesh).stem().u8string();
        name.assign(stem.begin(), stem.end());
    }
    return name + "-samples";
}

/// Names, by the mesh, of the files that the user does not name.
class FreeNames {
  public:
    /// `endings` of the samples and, where there is one to name, of the picture.
    FreeNames(std::string base, std::vector<std::string> endings)
        : base_(std::move(base)), endings_(std::move(endings)) {
        find_number();
    }

    /// Returns true if another program has taken a name; chooses the next one then.
    bool are_taken() {
        const int before = number_;
        find_number();
        return number_ != before;
    }

    std::string name(std::size_t file) const {
        return (number_ == 1 ? base_ : base_ + '-' + std::to_string(number_)) + endings_[file];
    }

    /// Gives the files names that nothing else has by then.
    void claim(const std::vector<AtomicFile*>& files) {
        while (!try_to_claim(files)) { // Another program was faster.
            ++number_;
            find_number();
        }
    }

  private:
    /// The first number from number_ on whose names no file has yet.
    void find_number() {
        const auto is_taken = [this](std::size_t file) { return exists(name(file)); };
        while (is_taken(0) || (endings_.size() > 1 && is_taken(1))) {
            ++number_;
        }
    }

    bool try_to_claim(const std::vector<AtomicFile*>& files) const {
        for (std::size_t i = 0; i < std::min(files.size(), endings_.size()); ++i) {
            if (!files[i]->claim(name(i))) {
                std::ranges::for_each(files, &AtomicFile::release);
                return false;
            }
        }
        return true;
    }

    std::string base_;
    std::vector<std::string> endings_;
    int number_ = 1;
};

/// Samples into files of the current folder that are named by the mesh and replace none.
void sample_to_free_names(SampleOptions options, bool draws) {
    const bool is_visible = options.mesh.edge_lengths.empty() || !options.mesh.coordinates.empty();
    const bool names_picture = draws && options.picture.empty() && is_visible;
    std::vector<std::string> endings{'.' +
                                     (options.out.format.empty() ? "ply" : options.out.format)};
    if (names_picture) {
        endings.emplace_back(".png");
    }
    FreeNames names(base_name(options.mesh.mesh), endings);
    bool has_picture = names_picture, are_claimed = false;
    const auto name = [&](const std::vector<AtomicFile*>& files, std::string& output,
                          std::string& picture) {
        names.claim(files);
        are_claimed = true;
        output = names.name(0);
        has_picture = !picture.empty();
        picture = names_picture && has_picture ? names.name(1) : picture;
    };
    for (bool is_done = false; !is_done;) {
        options.out.output = names.name(0);
        if (names_picture) {
            options.picture = names.name(1);
        }
        try {
            sample_to_files(options, {name, names_picture});
            is_done = true;
        } catch (const UserError& error) {
            // Where another program takes the names meanwhile, the next ones will do.
            if (are_claimed || error.code() != ExitCode::bad_output || !names.are_taken()) {
                throw;
            }
        }
    }
    if (names_picture && !has_picture && options.out.has_summary()) {
        std::cout << "picture       none, the device cannot draw\n";
        flush_or_fail("the summary");
    }
}

struct QuickOptions {
    SampleOptions sample;
    std::vector<std::string> meshes;
};

/// Throws UserError(usage) where one file would have to hold what comes of several meshes.
void check_no_outputs(const QuickOptions& options) {
    for (const auto& [name, path] : {std::pair{"--output", &options.sample.out.output},
                                     {"--picture", &options.sample.picture},
                                     {"--json", &options.sample.out.json}}) {
        if (!path->empty()) {
            fail_usage(std::string(name) + " names one file, but " +
                       grouped(options.meshes.size()) +
                       " meshes are given; leave it out, or use geodisk batch");
        }
    }
}

/// Returns true if nothing can go on after the error.
bool ends_all(const UserError& error) {
    return error.code() == ExitCode::no_device || static_cast<int>(error.code()) > 128;
}

/// Goes on behind meshes that fail.
void sample_each(const QuickOptions& options) {
    check_no_outputs(options);
    SampleOptions one = options.sample;
    one.mesh.mesh = options.meshes.front();
    parse_job(one); // Options that will not do for any mesh are told once.
    std::size_t failed = 0;
    for (const std::string& mesh : options.meshes) {
        one.mesh.mesh = mesh;
        try {
            sample_as_named(one, true);
        } catch (const UserError& error) {
            if (ends_all(error)) {
                throw;
            }
            print_failure(mesh, error.what());
            ++failed;
        }
    }
    if (failed > 0) {
        throw UserError(ExitCode::some_failed, counted(failed, "mesh", "meshes") + " of " +
                                                   grouped(options.meshes.size()) + " failed");
    }
}

void run_quick(QuickOptions options) {
    SampleOptions& sample = options.sample;
    if (sample.min_distance.empty() && sample.radius.empty() && sample.count.empty()) {
        sample.count = "10000";
    }
    if (options.meshes.size() > 1) {
        sample_each(options);
    } else {
        sample.mesh.mesh = options.meshes.front();
        sample_as_named(sample, true);
    }
}

bool is_folder(const Path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

/// Throws UserError(usage) for a word that is no mesh, with what it may stand for.
void check_mesh(Command app, const std::string& word) {
    if (is_builtin(word) || word == "-") {
        return;
    }
    if (is_folder(word)) {
        fail_usage(one_line(word) + " is a folder; to sample all meshes in it, run geodisk batch " +
                   shell_word(word) + " -o OUT --count N");
    }
    if (exists(word)) {
        return;
    }
    if (app.find_command(word)) {
        fail_usage("options come after the command: geodisk " + word + " ...");
    }
    std::vector<std::string> known = app.command_names();
    for (std::string& shape : builtin_names("builtin:")) {
        known.push_back(std::move(shape));
    }
    fail_usage(in_quotes(word) + ": no such command or mesh file" + did_you_mean(word, known));
}

/// Returns what may be given if a mesh alone is sampled: options of `quick` and of the program.
CommandFacts quick_facts(Command app) {
    CommandFacts facts = app.find_command("quick")->facts(true);
    const CommandFacts program = app.facts();
    facts.options.insert(facts.options.end(), program.options.begin(), program.options.end());
    return facts;
}

} // namespace

void sample_as_named(const SampleOptions& options, bool draws) {
    if (options.out.output.empty() && !options.out.is_dry_run) {
        sample_to_free_names(options, draws);
    } else {
        sample_to_files(options);
    }
}

void add_quick_command(Command app) {
    const Command command =
        app.add_command("quick", "Same as geodisk MESH: write about 10,000 samples to\n"
                                 "NAME-samples.ply, and a picture; never replace a file");
    const auto options = std::make_shared<QuickOptions>();
    add_mesh_arguments(command, options->meshes, "Meshes to sample");
    add_sample_options(command, options->sample, kNamedByMesh);
    command.has_footer(help_footer(kQuickExamples));
    command.calls([options] { run_quick(*options); });
}

void choose_command(Command app, std::vector<std::string>& arguments) {
    if (arguments.empty()) {
        return;
    }
    const std::string& first = arguments.front();
    if (first == "--help" || first == "-h" || first == "--version" || app.find_command(first)) {
        return;
    }
    if (!asks_for_help(arguments)) {
        const CommandLine line = sorted_words(quick_facts(app), arguments);
        if (!line.arguments.empty()) {
            check_mesh(app, line.arguments.front());
        }
    }
    arguments.insert(arguments.begin(), "quick");
}

} // namespace geodisk::tools
