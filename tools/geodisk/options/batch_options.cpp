#include "geodisk/options/batch_options.hpp"

#include <optional>
#include <vector>

#include "files/meshes/mesh_file.hpp"
#include "files/samples/sample_format.hpp"
#include "program/command.hpp"
#include "program/command_text.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/program.hpp"
#include "shapes/builtin_shapes.hpp"

namespace geodisk::tools {
namespace {

/// Adds the options that choose samples and what their file has of them, all but its name.
void add_manifest_options(Command command, SampleOptions& options) {
    add_subject_options(command, options);
    add_text_options(command, options.out);
    add_columns_options(command, options.out);
    add_scene_options(command, options.out);
}

void add_line_options(Command command, LineOptions& line) {
    add_mesh_argument(command, line.sample.mesh, "Mesh to sample");
    command.add_option("-o,--output", line.name, "NAME", "File to write, in the folder");
    add_manifest_options(command, line.sample);
}

void parse_words(const std::vector<std::string>& words, LineOptions& line) {
    run_arguments([&](Command command) { add_line_options(command, line); }, words);
}

/// `path`, relative to `folder`, for who works in the current one.
std::string seen_from(const Path& folder, const std::string& path) {
    return is_builtin(path) ? path : (folder / Path(path)).string();
}

/// Takes out of `common` what options on the number of candidates in `line` stand in for.
void drop_replaced_method(MethodOptions& common, const MethodOptions& line) {
    if (names_darts(line.method)) {
        common.pool_ratio.clear();
        common.exact = common.is_dense = common.is_maximal = false;
    } else if (!line.method.empty()) {
        common.darts.clear();
    }
    if (!line.pool_ratio.empty() || line.is_maximal) {
        common.is_dense = false;
    }
    if (line.is_dense) {
        common.pool_ratio.clear();
        common.is_maximal = false;
    }
    if (!line.order.empty() && line.order != common.order) {
        common.levels.clear();
        common.level_factor.clear();
        common.keep.clear();
    }
}

/// Takes out of `common` what an option of another name in `line` stands in for.
void drop_replaced(SampleOptions& common, const SampleOptions& line) {
    const std::string& method =
        line.method.method.empty() ? common.method.method : line.method.method;
    const bool throws_darts = names_darts(method);
    const bool has_length =
        !line.min_distance.empty() || !line.radius.empty() || has_distances(line.classes);
    // If darts stop at a count, the count goes with a length.
    if (has_length || (!line.count.empty() && !throws_darts)) {
        common.min_distance.clear();
        common.radius.clear();
    }
    if ((!line.min_distance.empty() || !line.radius.empty()) && has_distances(common.classes)) {
        common.classes.clear();
    }
    if (has_length && !throws_darts) {
        common.count.clear();
        common.method.exact = false;
    }
    drop_replaced_method(common.method, line.method);
    if (!line.density.given().empty()) {
        common.density = {};
    }
    if (!line.mask.only.empty()) {
        common.mask.only.clear();
    }
}

/// Takes a value if the line gives it.
template <class Value>
void take_given(Value& of_all, const Value& of_line) {
    if (!of_line.empty()) {
        of_all = of_line;
    }
}

} // namespace

Shard BatchOptions::parsed_shard() const {
    if (shard.empty()) {
        return {};
    }
    const std::size_t slash = shard.find('/');
    const auto index = parse_integer<std::size_t>(shard.substr(0, slash));
    const auto count = slash == std::string::npos
                           ? std::nullopt
                           : parse_integer<std::size_t>(shard.substr(slash + 1));
    if (!index || !count || *index >= *count) {
        fail_usage("--shard: " + in_quotes(shard) +
                   " is not a part I/N of N, counted from 0: 0/4 to 3/4");
    }
    return {*index, *count};
}

void add_batch_options(Command command, BatchOptions& options) {
    command
        .add_option("INPUT", options.inputs, "",
                    "Meshes, folders of meshes (with subfolders), and manifests:\n"
                    "text files with a mesh on each line and options for it")
        .offers(builtin_names("builtin:"))
        .required();
    command
        .add_option("-o,--output", options.folder, "DIR",
                    "Folder to write to: samples and batch.jsonl, the log")
        .required();
    command
        .add_option("--format", options.format, "NAME",
                    "Format of the samples, as for geodisk sample")
        .offers(sample_formats())
        .shows_default();
    const char* const group = "Batch";
    command
        .add_option("--jobs", options.jobs, "K",
                    "Meshes in work at the same time, 1 to 32 (default 4 per\n"
                    "device)",
                    group)
        .takes_range(1, kMaxJobs);
    command.add_option("--shard", options.shard, "I/N",
                       "Sample every Nth mesh only, starting with the Ith, counted\n"
                       "from 0; the log is then batch-I-of-N.jsonl",
                       group);
    command.add_flag("--resume", options.resumes,
                     "Continue a batch: skip meshes that are done with the same\n"
                     "options according to the logs in DIR",
                     group);
    command.add_flag("--keep-extensions", options.keeps_extensions,
                     "Name the samples of a.obj a.obj.ply, so that they do not\n"
                     "collide with those of a.ply",
                     group);
    command
        .add_option("--device", options.devices, "NAME|INDEX",
                    "Device by name, index or UUID (geodisk info), or all; may\n"
                    "be given several times (default GEODISK_DEVICE; else all\n"
                    "GPUs; else the best device)",
                    group)
        .takes_one_value();
    add_subject_options(command, options.sample);
    add_validate_option(command, options.sample.run.device);
    add_limit_options(command, options.sample.run);
    add_json_option(command, options.sample.out);
    add_text_options(command, options.sample.out);
    add_columns_options(command, options.sample.out);
    add_scene_options(command, options.sample.out);
    add_quiet_option(command, options.sample.out);
}

LineOptions parse_line(const SampleOptions& common, const std::vector<std::string>& words,
                       const Path& folder) {
    LineOptions alone;
    alone.sample.method.method.clear(); // To see whether the line gives them.
    alone.sample.method.order.clear();
    parse_words(words, alone);
    LineOptions line{common, alone.sample.mesh.mesh, {}};
    drop_replaced(line.sample, alone.sample);
    parse_words(words, line);
    place_files(alone.sample,
                [&folder](const std::string& name) { return seen_from(folder, name); });
    SampleOptions& sample = line.sample;
    const SampleOptions& own = alone.sample;
    take_given(sample.mesh.mesh, own.mesh.mesh);
    take_given(sample.mesh.coordinates, own.mesh.coordinates);
    take_given(sample.mesh.edge_lengths, own.mesh.edge_lengths);
    take_given(sample.out.record.texture, own.out.record.texture);
    take_given(sample.out.record.attributes, own.out.record.attributes);
    if (!own.density.given().empty()) {
        sample.density = own.density;
    }
    take_given(sample.mask.masks, own.mask.masks);
    take_given(sample.mask.class_masks, own.mask.class_masks);
    take_given(sample.mask.class_densities, own.mask.class_densities);
    take_given(sample.constraints.existing, own.constraints.existing);
    take_given(sample.constraints.avoid, own.constraints.avoid);
    take_given(sample.constraints.class_avoid, own.constraints.class_avoid);
    take_given(sample.classes, own.classes);
    return line;
}

std::string sample_command(const SampleOptions& options) {
    SampleOptions given = options, usual;
    std::vector<std::string> words{"sample", options.mesh.mesh, "-o", options.out.output};
    const std::vector<std::string> more =
        words_of([&](Command command) { add_manifest_options(command, given); },
                 [&](Command command) { add_manifest_options(command, usual); });
    words.insert(words.end(), more.begin(), more.end());
    return command_text("geodisk", words);
}

} // namespace geodisk::tools
