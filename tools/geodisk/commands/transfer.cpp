
#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <geodisk/version.hpp>

#include "files/output_file.hpp"
#include "files/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/tolerance_option.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/records.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geometry/mesh.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kExamples[] = {
    "geodisk transfer points.csv standing.obj sitting.obj -o sitting.csv",
};

struct TransferOptions {
    std::string samples;
    MeshOptions from, to;
    OutputOptions out;
    std::string tolerance;
};

/// The mesh to move samples to, with what they get of it.
MeshOptions target_mesh(const TransferOptions& options) {
    MeshOptions mesh = options.to;
    mesh.fields = options.out.record.fields();
    mesh.texture = options.out.record.texture;
    return mesh;
}

void check_files(const TransferOptions& options) {
    std::vector<NamedFile> read{{"the samples read", options.samples}};
    options.from.add_files(read, "a mesh");
    target_mesh(options).add_files(read, "a mesh");
    check_outputs(options.out, "the output", read);
    options.out.record.check(options.out.target());
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

/// What holds of the new samples, then what the header of the old ones said, as "source_KEY".
SampleHeader transferred_header(const TransferOptions& options, const SampleHeader& source,
                                const std::optional<ClosePair>& closest) {
    SampleHeader header{
        {{"version", "geodisk " GEODISK_VERSION_STRING}, {"mesh", options.to.mesh}}};
    for (const auto& entry : options.to.additions()) {
        header.entries.push_back(entry);
    }
    if (closest) {
        header.entries.emplace_back("min_distance", exact_text(closest->distance));
    }
    header.entries.emplace_back("transferred_from", options.samples);
    for (const auto& entry : options.out.record.entries()) {
        header.entries.push_back(entry);
    }
    for (const auto& [key, value] : source.entries) {
        header.entries.emplace_back("source_" + key, value);
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

std::string report_text(const TransferOptions& options, const MeshInput& from, const MeshInput& to,
                        const SampleFile& samples, const std::optional<ClosePair>& closest) {
    return text_of(Json{{"version", GEODISK_VERSION_STRING},
                        {"transferred_from", options.samples},
                        {"mesh_a", mesh_json(options.from.mesh, options.from.additions(), from)},
                        {"mesh_b", mesh_json(options.to.mesh, options.to.additions(), to)},
                        {"warnings_a", warnings_json(from.warnings)},
                        {"warnings_b", warnings_json(to.warnings)},
                        {"output", options.out.output},
                        {"samples", samples.rows.size()},
                        {"smallest", pair_json(closest)}});
}

std::string summary_text(const TransferOptions& options, const MeshInput& from, const MeshInput& to,
                         const SampleFile& samples, const std::optional<ClosePair>& closest) {
    std::ostringstream out;
    out << mesh_lines("from", options.from.mesh, options.from.additions(), from)
        << mesh_lines("to", options.to.mesh, options.to.additions(), to) << "samples       "
        << grouped(samples.rows.size()) << " of " << one_line(options.samples) << '\n'
        << "smallest      " << closest_text(closest) << '\n'
        << "file          " << one_line(options.out.output) << '\n';
    return out.str();
}

void run_transfer(const TransferOptions& options) {
    check_files(options);
    check_tolerance(options.tolerance);
    ProgressLine progress(options.out.quiet);
    MeshInput from = load_mesh(options.from, progress);
    const MeshOptions to_options = target_mesh(options);
    const MeshInput to = load_mesh(to_options, progress);
    check_connectivity(options, from.file, to.file);
    check_dimension(options.out.target(), to.dimension());
    check_record(options.out.record, to);
    SampleFile samples = read_samples_exactly_on(options.samples, options.from.mesh, from, nullptr,
                                                 options.tolerance, from.warnings, progress);
    for (SampleRow& row : samples.rows) {
        to.place(row);
        row.radius = 0; // That was one on the other mesh.
    }
    set_normals(options.out.record, to, samples.rows);
    const std::optional<ClosePair> closest = find_closest(to, samples.rows, progress);
    print_precision_note(options.out, samples.rows, to.dimension());
    const std::vector<SampleField> fields =
        record_fields(options.out.record, to, samples.rows, seed_of(samples.header));
    AtomicFile file(options.out.output);
    write_samples(file, options.out.target(), transferred_header(options, samples.header, closest),
                  samples.rows, to.dimension(), {samples.extra, fields});
    file.sync();
    publish(options.out, {&file}, report_text(options, from, to, samples, closest),
            summary_text(options, from, to, samples, closest));
}

} // namespace

void add_transfer_command(Command app) {
    const Command command = app.add_command(
        "transfer", "Move samples to another pose of their mesh, with identical faces,\n"
                    "and report their minimum distance there");
    const auto options = std::make_shared<TransferOptions>();
    command
        .add_option("SAMPLES", options->samples, "",
                    "Samples of MESH_A: *.ply, *.csv, *.npz or *.pcd, or points of\n"
                    "another program, also *.npy, *.obj and *.xyz")
        .required();
    add_mesh_argument(command, options->from, "Mesh that the samples were made on", "MESH_A");
    add_mesh_argument(command, options->to, "Mesh with identical faces to move them to", "MESH_B");
    add_output_argument(command, options->out);
    add_format_option(command, options->from, "-a");
    add_format_option(command, options->to, "-b");
    add_sidecar_options(command, options->from, "MESH_A", "-a");
    add_sidecar_options(command, options->to, "MESH_B", "-b");
    add_lift_option(command, options->to, "-b");
    add_weld_options(command, options->from, "-a");
    add_weld_options(command, options->to, "-b");
    add_tolerance_option(command, options->tolerance);
    add_record_options(command, options->out.record, "MESH_B");
    add_output_options(command, options->out);
    command.has_footer(help_footer(kExamples));
    command.calls([options] { run_transfer(*options); });
}

} // namespace geodisk::tools
