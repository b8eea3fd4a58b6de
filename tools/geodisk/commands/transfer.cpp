
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <geodisk/version.hpp>

#include "files/output/output_file.hpp"
#include "files/samples/fingerprint.hpp"
#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/farthest_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/method_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/outputs/scene_frame.hpp"
#include "geodisk/records.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geometry/mesh.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kTransferExamples[] = {
    "geodisk transfer points.csv standing.obj sitting.obj -o sitting.csv",
    "geodisk transfer points.csv mesh.obj mesh.obj --order farthest --keep 100 -o first.csv",
};

struct TransferOptions {
    std::string samples;
    MeshOptions from, to;
    OutputOptions out;
    RunOptions run;
    std::string tolerance, order = "file", keep, start, first;

    bool is_farthest() const { return order == "farthest"; }
};

/// Result of the command.
struct Transfer {
    MeshInput from, to;
    SampleFile samples{};
    std::optional<ClosePair> closest{};
    std::optional<FarthestRun> farthest{}; ///< If the samples are in its order.
    std::optional<SceneFrame> scene{};
};

/// The mesh to move samples to, with what they get of it.
MeshOptions target_mesh(const TransferOptions& options) {
    MeshOptions mesh = options.to;
    mesh.fields = options.out.record.fields();
    mesh.texture = options.out.record.image();
    return mesh;
}

void check_files(const TransferOptions& options) {
    std::vector<NamedFile> read{{"the samples read", options.samples}};
    options.from.add_files(read, "a mesh");
    target_mesh(options).add_files(read, "a mesh");
    check_outputs(options.out, "the output", read);
    options.out.record.check(options.out.target());
    options.out.check_scene(false);
}

MeshInput load(const MeshOptions& mesh, ProgressLine& progress) {
    return load_mesh(mesh, progress, {}, {}, "give SAMPLES MESH_A MESH_B in this order");
}

std::string corners_text(const MeshFile& mesh, std::size_t face) {
    std::string text;
    for (std::size_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
        text += (text.empty() ? "" : " ") + std::to_string(mesh.corners_in_file()[corner]);
    }
    return text;
}

/// A face and weights mean the same place only where the corners are the same. Which of them are
/// joined may differ: seams that are closed in one pose may be open in another.
void check_connectivity(const TransferOptions& options, const MeshFile& from, const MeshFile& to) {
    const std::size_t count = from.triangles.size() / 3;
    if (to.triangles.size() != from.triangles.size()) {
        fail_input(options.to.mesh, "has " +
                                        counted(to.triangles.size() / 3, "triangle", "triangles") +
                                        ", but " + options.from.mesh + " has " + grouped(count) +
                                        "; transfer needs two meshes with identical faces");
    }
    const std::vector<std::uint32_t>& corners = from.corners_in_file();
    const auto difference =
        std::mismatch(corners.begin(), corners.end(), to.corners_in_file().begin()).first;
    if (difference != corners.end()) {
        const auto face = static_cast<std::size_t>(difference - corners.begin()) / 3;
        fail_input(options.to.mesh,
                   "face " + std::to_string(face) + " has the corners " + corners_text(to, face) +
                       ", but " + corners_text(from, face) + " in " + options.from.mesh +
                       " (all counted from 0); transfer needs two meshes with identical faces");
    }
}

/// Adds a warning where the header of the samples tells of other walls than the options.
void warn_of_other_walls(const SampleFile& samples, const std::vector<std::string>& walls,
                         std::vector<MeshWarning>& warnings) {
    std::vector<std::string> told;
    for (const auto& [key, value] : samples.header.entries) {
        if (key == "walls") {
            told.push_back(value);
        }
    }
    if (told != walls && !samples.header.entries.empty()) { // Points of other programs have none.
        warnings.push_back({"other_surface", 1, "",
                            told.empty() ? "made without --walls, so distances may differ"
                                         : "made with --walls " + listed(told) +
                                               "; give the same, or distances cross them",
                            samples.path});
        print_warning(samples.path + ": " + warnings.back().message);
    }
}

/// Returns the header of the new samples: first what holds of them, then the header of the old
/// ones, as "source_KEY".
SampleHeader transferred_header(const TransferOptions& options, const Transfer& done) {
    SampleHeader header{
        {{"version", "geodisk " GEODISK_VERSION_STRING}, {"mesh", options.to.mesh}}};
    const auto add = [&](const HeaderEntries& more) {
        header.entries.insert(header.entries.end(), more.begin(), more.end());
    };
    add(done.to.additions);
    if (done.closest) {
        add({{"min_distance", exact_text(done.closest->distance)}});
    }
    add({{"transferred_from", options.samples},
         {std::string(kDigest), digest_of(done.samples.rows)}});
    add(options.out.record.entries());
    add(frame_entries(frame_style(options.out, options.to)));
    if (done.farthest) {
        add(farthest_entries(*done.farthest));
    }
    for (const auto& [key, value] : done.samples.header.entries) {
        add({{"source_" + key, value}});
    }
    return header;
}

/// The seed of the samples, so that frames turn with them; 0 if the file does not say it.
std::uint64_t seed_of(const SampleHeader& header) {
    for (const char* const key : {"seed", "source_seed"}) {
        if (const std::string* const text = header.find(key)) {
            return parse_integer<std::uint64_t>(*text).value_or(0);
        }
    }
    return 0;
}

std::string report_text(const TransferOptions& options, const Transfer& done) {
    return text_of(Json{{"version", GEODISK_VERSION_STRING},
                        {"transferred_from", options.samples},
                        {"mesh_a", mesh_json(done.from)},
                        {"mesh_b", mesh_json(done.to)},
                        {"warnings_a", warnings_json(done.from.warnings)},
                        {"warnings_b", warnings_json(done.to.warnings)},
                        {"output", options.out.output},
                        {"samples", done.samples.rows.size()},
                        {"farthest", done.farthest ? farthest_json(*done.farthest) : Json(nullptr)},
                        {"scene", scene_json(done.scene)},
                        {"smallest", pair_json(done.closest)}});
}

std::string summary_text(const TransferOptions& options, const Transfer& done) {
    std::ostringstream out;
    out << mesh_lines("from", done.from) << mesh_lines("to", done.to) << "samples       "
        << grouped(done.samples.rows.size()) << " of " << one_line(options.samples) << '\n';
    if (done.farthest) {
        out << farthest_line(*done.farthest);
    }
    out << "smallest      " << closest_text(done.closest) << '\n'
        << "file          " << one_line(options.out.output) << '\n'
        << frame_line(frame_style(options.out, options.to)) << scene_line(done.scene);
    return out.str();
}

/// Puts the samples in farthest-point order on the mesh that they are moved to.
FarthestRun put_farthest_first(const TransferOptions& options, const RunnerOptions& runner,
                               const FarthestParams& params, const MeshInput& mesh,
                               SampleFile& samples, ProgressLine& progress) {
    RunDevice device(options.run.device, runner);
    FarthestRun run = order_farthest(mesh, samples.rows, params, device, progress);
    run.apply(samples.rows);
    for (ExtraColumn& column : samples.extra) {
        run.apply(column.values);
    }
    return run;
}

FarthestParams parse_order(const TransferOptions& options) {
    check_choice("--order", options.order, std::vector<std::string>{"file", "farthest"});
    if (!options.start.empty() && !options.first.empty()) {
        fail_usage(
            "--start and --first exclude each other: the first samples of a file come first");
    }
    FarthestParams params{parse_keep(options.keep, options.is_farthest())};
    for (const auto& [name, text, number] :
         {std::tuple("--start", &options.start, &params.start),
          std::tuple("--first", &options.first, &params.existing)}) {
        if (text->empty()) {
            continue;
        }
        if (!options.is_farthest()) {
            fail_usage(std::string(name) + " is for --order farthest");
        }
        const auto value = parse_integer<std::uint32_t>(*text);
        if (!value) {
            fail_usage(std::string(name) + ": " + in_quotes(*text) +
                       " is not a whole number from 0 to 4294967295");
        }
        *number = *value;
    }
    return params;
}

void run_transfer(const TransferOptions& options) {
    const FarthestParams order = parse_order(options);
    const RunnerOptions runner = options.run.runner();
    check_files(options);
    check_tolerance(options.tolerance);
    ProgressLine progress(options.out.quiet);
    MeshOptions from = options.from;
    from.walls = options.to.walls; // The faces of both are the same.
    Transfer done{load(from, progress), load(target_mesh(options), progress)};
    const MeshInput& to = done.to;
    check_connectivity(options, done.from.file, to.file);
    check_dimension(options.out.target(), to.dimension());
    check_record(options.out.record, to);
    SampleFile& samples = done.samples;
    samples = read_samples_exactly_on(options.samples, done.from, options.tolerance,
                                      done.from.warnings, progress, {.compares_surface = false});
    warn_of_no_samples(samples, done.from.warnings);
    warn_of_other_walls(samples, options.to.walls, done.from.warnings);
    if (options.is_farthest()) {
        done.farthest = put_farthest_first(options, runner, order, to, samples, progress);
    }
    for (SampleRow& row : samples.rows) {
        to.place(row);
        row.radius = 0; // That was one on the other mesh.
    }
    set_normals(options.out.record, to, samples.rows);
    done.closest = find_closest(to, samples.rows, progress);
    print_precision_note(options.out, samples.rows, to.dimension());
    std::vector<SampleField> fields = record_fields(to, samples.rows, seed_of(samples.header),
                                                    frame_style(options.out, options.to));
    if (done.farthest && takes_column(options.out, kCoverColumn)) {
        std::ranges::copy(done.farthest->columns(), std::back_inserter(fields));
    }
    done.scene = scene_frame(options.out, options.to, to);
    AtomicFile file(options.out.output);
    write_samples(file, target_in(options.out, done.scene), transferred_header(options, done),
                  samples.rows, to.dimension(), {samples.extra, fields});
    file.sync();
    publish(options.out, {&file}, report_text(options, done), summary_text(options, done));
}

} // namespace

void add_transfer_command(Command app) {
    const Command command = app.add_command(
        "transfer", "Move samples to another pose of their mesh, with identical faces,\n"
                    "and report their minimum distance there");
    const auto options = std::make_shared<TransferOptions>();
    command.add_option("SAMPLES", options->samples, "", help_of_input("Samples of MESH_A"))
        .required();
    add_mesh_argument(command, options->from, "Mesh that the samples were made on", "MESH_A");
    add_mesh_argument(command, options->to, "Mesh with identical faces to move them to", "MESH_B");
    add_output_argument(command, options->out);
    add_reader_options(command, options->from, "-a");
    add_reader_options(command, options->to, "-b");
    add_sidecar_options(command, options->from, "MESH_A", "-a");
    add_sidecar_options(command, options->to, "MESH_B", "-b");
    add_lift_option(command, options->to, "-b");
    add_walls_option(command, options->to);
    add_weld_options(command, options->from, "-a");
    add_weld_options(command, options->to, "-b");
    add_tolerance_option(command, options->tolerance);
    add_record_options(command, options->out.record, "MESH_B");
    command
        .add_option("--order", options->order, "NAME",
                    "file: the order of the file; farthest: after the first sample,\n"
                    "always the one farthest from all before it along the surface\n"
                    "of MESH_B (column cover: that distance; column row: place in\n"
                    "the file, from 0)")
        .offers({"file", "farthest"})
        .shows_default();
    add_keep_option(command, options->keep);
    command.add_option("--start", options->start, "ROW",
                       "Begin --order farthest with this sample, counted from 0");
    command.add_option("--first", options->first, "K",
                       "Leave the first K samples where they are: --order farthest goes on\n"
                       "with the one farthest from all of these");
    add_device_options(command, options->run.device);
    add_limit_options(command, options->run);
    add_output_options(command, options->out);
    command.has_footer(help_footer(kTransferExamples));
    command.calls([options] { run_transfer(*options); });
}

} // namespace geodisk::tools
