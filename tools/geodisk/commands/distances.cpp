#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/version.hpp>

#include "files/samples/distance_file.hpp"
#include "files/samples/gifti_writer.hpp"
#include "files/samples/neighbour_file.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/inputs/source_points.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "picture/png.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kDistancesExamples[] = {
    "geodisk distances bunny.obj --vertices 0 -o distances.npz --picture isolines.png",
    "geodisk distances terrain.ply wells.csv -o nearest.csv",
    "geodisk distances lh.white --vertices 0 -o lh.distance.shape.gii",
    "geodisk distances brain.obj electrodes.csv --each --within 50 -o rows.npz",
};

struct DistanceCommand {
    MeshOptions mesh;
    SourceOptions source;
    OutputOptions out;
    DeviceOptions device;
    std::string within, picture;
    bool each = false;
};

/// Tells what was measured.
struct DistanceReport {
    const DistanceCommand& options;
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings;
    const DistanceTable& table;
    std::size_t reached;
    double largest, seconds;

    std::string json(double write_seconds) const {
        return text_of({{"version", GEODISK_VERSION_STRING},
                        {"mesh", mesh_json(mesh)},
                        {"warnings", warnings_json(warnings)},
                        {"sources", table.sources.size()},
                        {"each", options.each},
                        {"distances", table.distances.size()},
                        {"reached", reached},
                        {"largest", largest},
                        {"output", options.out.output},
                        {"picture", options.picture.empty() ? Json() : Json(options.picture)},
                        {"seconds",
                         {{"load", mesh.load_seconds},
                          {"prepare", mesh.prepare_seconds},
                          {"measure", seconds},
                          {"write", write_seconds}}}});
    }

    std::string summary(double write_seconds) const {
        std::ostringstream out;
        out << mesh_lines("mesh", mesh) << "sources       " << grouped(table.sources.size())
            << (options.each ? ", each on its own\n" : "\n") << "distances     " << grouped(reached)
            << " of " << grouped(table.distances.size()) << ", up to " << rounded(largest, 6)
            << " in mesh units\n"
            << "time          " << seconds_text(seconds) << " measuring, "
            << seconds_text(write_seconds) << " writing\n"
            << "file          " << one_line(options.out.output) << '\n';
        if (!options.picture.empty()) {
            out << "picture       " << one_line(options.picture) << '\n';
        }
        return out.str();
    }
};

/// Returns the surface, coloured by distance.
DrawnPicture draw_distances(const DistanceCommand& options, const MeshInput& mesh,
                            const DistanceTable& table, double largest, ProgressLine& progress) {
    picture::Scene scene = make_scene(options.mesh, mesh);
    for (std::size_t corner = 0; corner < scene.corners.size(); ++corner) {
        const double distance = table.distances[mesh.file.triangles[corner]];
        scene.corners[corner].value = std::isfinite(distance) ? static_cast<float>(distance) : -1;
    }
    picture::WindowTable nothing;
    const std::size_t faces = scene.corners.size() / 3;
    nothing.faces.resize(faces, {1, 0, 1, 0, 1, 1, 1, 0});
    nothing.starts.assign(faces + 1, 0);
    picture::Content content{scene, nothing, {}};
    content.largest_value = largest > 0 ? static_cast<float>(largest) : 1;
    picture::PictureParams params;
    params.style = picture::Style::distance;
    const Context context = open_device(options.device, true, progress);
    return draw_content(context, params, content, progress);
}

void check_files(const DistanceCommand& options) {
    std::vector<NamedFile> read;
    options.mesh.add_files(read, "the mesh");
    options.source.add_files(read);
    if (!options.picture.empty()) {
        check_picture_path(options.picture);
    }
    check_outputs(options.out, "the distances", read, [](const Path&) {},
                  {{"the picture", options.picture}});
}

NumberedPoints sources_on(const DistanceCommand& options, const std::vector<VertexRange>& vertices,
                          const MeshInput& mesh, std::vector<MeshWarning>& warnings,
                          ProgressLine& progress) {
    if (options.source.points.empty()) {
        return vertices_of(mesh, vertices);
    }
    NumberedPoints sources{
        samples_of(options.source.read(options.source.points, {}, mesh, warnings, progress).rows),
        {}};
    sources.numbers.resize(sources.points.size());
    std::iota(sources.numbers.begin(), sources.numbers.end(), 0u);
    return sources;
}

DistanceTable measure(const DistanceCommand& options, const std::optional<Length>& within,
                      NumberedPoints sources, const MeshInput& mesh, ProgressLine& progress) {
    DistanceQuery query;
    query.sources = sources.points;
    query.each = options.each;
    query.joined = mesh.file.joined;
    if (within) {
        query.within = distance_on_mesh(*within, mesh.prepared.statistics());
    }
    progress.begin_stage("measuring");
    auto found = geodesic_distances(mesh.prepared, query, {}, [&](const Progress& state) {
        progress.update(static_cast<double>(state.decided) / state.candidates, "");
        return !is_interrupted();
    });
    progress.clear();
    check_interrupted();
    if (!found && found.error().status == Status::mesh_rejected) {
        fail_input(options.mesh.mesh, found.error().message);
    }
    GeodesicDistances distances = take(std::move(found));
    for (std::uint32_t& nearest : distances.nearest) {
        nearest = nearest == GeodesicDistances::kNone ? nearest : sources.numbers[nearest];
    }
    return {std::move(sources.numbers), std::move(distances.distances),
            std::move(distances.nearest)};
}

/// Returns true for GIFTI. Throws UserError(usage) for a file of labels.
bool writes_gifti(const OutputOptions& out) {
    if (out.output.ends_with(".label.gii")) {
        fail_usage(out.output + ": distances are no labels; write *.shape.gii");
    }
    return out.format.empty() ? is_gifti(out.output) : out.format == "gii";
}

/// Returns how to write the table.
std::function<void(AtomicFile&)> writer_of(const DistanceCommand& options,
                                           const DistanceTable& table) {
    if (writes_gifti(options.out)) {
        return [&](AtomicFile& file) {
            write_gifti_distances(
                file, table,
                {{"version", "geodisk " GEODISK_VERSION_STRING}, {"mesh", options.mesh.mesh}});
        };
    }
    const SampleTarget target = neighbour_target(options.out.output, options.out.format,
                                                 "distances", ".npz, .csv or .shape.gii");
    return [&table, target](AtomicFile& file) { write_distances(file, target, table); };
}

/// Returns the largest distance that is finite, or 0.
double largest_in(const DistanceTable& table) {
    double largest = 0;
    for (const double distance : table.distances) {
        largest = std::isfinite(distance) ? std::max(largest, distance) : largest;
    }
    return largest;
}

/// Takes out the copies of vertices, which walls made: each vertex gets the nearest distance of all
/// its sides.
void fold_copies(const MeshFile& mesh, std::size_t vertices, DistanceTable& table) {
    if (mesh.copied.empty()) {
        return;
    }
    const std::size_t own = mesh.file_vertices(vertices);
    DistanceTable folded{table.sources, {}, {}};
    for (std::size_t row = 0; row < table.distances.size(); row += vertices) {
        const auto nearer = [&](std::size_t at, std::size_t than) {
            if (table.distances[row + at] < table.distances[row + than]) {
                table.distances[row + than] = table.distances[row + at];
                if (!table.nearest.empty()) {
                    table.nearest[than] = table.nearest[at];
                }
            }
        };
        for (std::size_t v = own; v < vertices; ++v) {
            nearer(v, mesh.copied[v - own]);
        }
        for (std::size_t v = 0; v < own && !mesh.joined.empty(); ++v) {
            nearer(mesh.joined[v], v);
        }
        const auto first = table.distances.begin() + static_cast<std::ptrdiff_t>(row);
        folded.distances.insert(folded.distances.end(), first,
                                first + static_cast<std::ptrdiff_t>(own));
    }
    table.nearest.resize(table.nearest.empty() ? 0 : own);
    folded.nearest = std::move(table.nearest);
    table = std::move(folded);
}

void run_distances(const DistanceCommand& options) {
    DistanceTable table;
    const std::function<void(AtomicFile&)> write = writer_of(options, table);
    const std::vector<VertexRange> vertices = options.source.ranges();
    if (options.source.points.empty() && vertices.empty()) {
        fail_usage("give --vertices, or POINTS: from where to measure");
    }
    if (options.each && !options.picture.empty()) {
        fail_usage("--picture shows the distances from the nearest source; leave out --each");
    }
    std::optional<Length> within;
    if (!options.within.empty()) {
        within = parse_length("--within", options.within);
    }
    check_tolerance(options.source.tolerance);
    check_files(options);

    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    if (!options.picture.empty()) {
        check_visible(mesh);
    }
    std::vector<MeshWarning> warnings;
    NumberedPoints sources = sources_on(options, vertices, mesh, warnings, progress);
    print_warnings(warnings);
    warnings.insert(warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    const double seconds =
        seconds_of([&] { table = measure(options, within, std::move(sources), mesh, progress); });
    picture::Pixels pixels;
    if (!options.picture.empty()) {
        pixels = draw_distances(options, mesh, table, largest_in(table), progress).picture.pixels;
    }
    fold_copies(mesh.file, mesh.prepared.vertex_count(), table);
    const auto reached = static_cast<std::size_t>(
        std::ranges::count_if(table.distances, [](double d) { return std::isfinite(d); }));
    const DistanceReport report{options,           mesh,   warnings, table, reached,
                                largest_in(table), seconds};
    write_outputs(options.out, "the distances", progress, report, write,
                  {{options.picture, [&](AtomicFile& file) { picture::write_png(file, pixels); }}});
}

} // namespace

void add_distances_command(Command app) {
    const Command command = app.add_command(
        "distances", "Measure the exact distance of every vertex from sources, along the\n"
                     "surface; needs no device");
    const auto options = std::make_shared<DistanceCommand>();
    add_mesh_argument(command, options->mesh, "Mesh to measure on");
    command.add_option("POINTS", options->source.points, "",
                       "Sources: samples of MESH, or points of another program,\n"
                       "put on the nearest face");
    add_output_argument(command, options->out,
                        "File to write: *.npz (arrays sources, distances, nearest),\n"
                        "*.csv (vertex, distance, source) or *.shape.gii (GIFTI)");
    command.add_flag("--each", options->each,
                     "Measure from each source on its own, not from the nearest: a\n"
                     "row of distances for each");
    command.add_option("--within", options->within, "R",
                       "Leave out what is farther: in mesh units, or 1% of the diagonal");
    command.add_option("--picture", options->picture, "FILE",
                       "Draw the distances too, with a line at each twentieth of the\n"
                       "largest, as *.png; needs a device");
    add_source_options(command, options->source,
                       "Sources: these vertices, such as 0,5,10-20, or @FILE with such\n"
                       "numbers, separated by blanks or lines");
    add_mesh_options(command, options->mesh);
    add_json_option(command, options->out);
    command.add_option("--format", options->out.format, "FORMAT",
                       "Write npz, csv or gii, ignoring the extension of OUT");
    add_quiet_option(command, options->out);
    add_device_options(command, options->device);
    command.has_footer(help_footer(kDistancesExamples));
    command.calls([options] { run_distances(*options); });
}

} // namespace geodisk::tools
