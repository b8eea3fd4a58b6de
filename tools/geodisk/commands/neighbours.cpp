#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/version.hpp>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/inputs/source_points.hpp"
#include "geodisk/neighbour_run.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kNeighboursExamples[] = {
    "geodisk neighbours brain.obj --within 10 -o near.npz",
    "geodisk neighbours brain.obj electrodes.csv --within 10 -o near.csv",
    "geodisk neighbours terrain.ply wells.csv --within reach --among houses.csv -o near.csv",
    "geodisk neighbours cortex.gii --vertices 0,100 --within area:1% -o patches.csv",
    "geodisk neighbours bunny.ply points.ply --within 5% --among sources --nearest 6 -o graph.npz",
};

struct NeighbourOptions {
    MeshOptions mesh;
    MaskOptions mask;
    OutputOptions out;
    RunOptions run;
    SourceOptions source;
    std::string within, among = "vertices", nearest, max_pairs;

    /// Returns the file of the points to search; "" for others.
    std::string searched() const { return among == "vertices" || among == "sources" ? "" : among; }
};

/// The distance of all sources, the column that has one for each, or the area that disks hold.
struct Within {
    std::optional<Length> length{};
    std::string column{};
    std::optional<Length> area{}; ///< In square mesh units, or % of the area of the mesh.
};

constexpr std::string_view kArea = "area:";

/// Reads an area: in square mesh units, or % of that of the mesh.
Length parse_area(const std::string& within) {
    std::string_view number = std::string_view(within).substr(kArea.size());
    const bool is_percent = number.ends_with('%');
    number.remove_suffix(is_percent ? 1 : 0);
    const auto value = parse_positive(number);
    if (!value) {
        fail_usage("--within: " + in_quotes(within) +
                   " is no positive, finite area; give area:1% of the mesh, or square mesh units");
    }
    return {*value, is_percent};
}

Within parsed_within(const NeighbourOptions& options) {
    if (options.within.empty()) {
        if (options.nearest.empty()) {
            fail_usage("give --within, the distance within which neighbours are, or --nearest");
        }
        return {};
    }
    if (options.within.starts_with(kArea)) {
        return {{}, {}, parse_area(options.within)};
    }
    const char first = options.within.front();
    const bool is_number = (first >= '0' && first <= '9') || first == '+' || first == '-' ||
                           first == '.' || parse_real(options.within); // inf and nan as well.
    if (is_number) {
        return {parse_length("--within", options.within), {}};
    }
    if (options.source.points.empty()) {
        fail_usage("--within: " + in_quotes(options.within) +
                   " is no length; for a column, give POINTS that have it");
    }
    return {{}, options.within};
}

void check_files(const NeighbourOptions& options) {
    std::vector<NamedFile> read;
    options.mesh.add_files(read, "the mesh");
    options.mask.add_files(read);
    options.source.add_files(read);
    if (!options.searched().empty()) {
        read.push_back({"the points to search", options.searched()});
    }
    check_outputs(options.out, "the neighbours", read, [](const Path&) {});
}

std::vector<double> radii_in(const std::string& path, const std::string& column,
                             const SampleFile& file) {
    for (std::size_t i = 0; i < file.numbers.size(); ++i) {
        if (!(file.numbers[i] > 0) || !std::isfinite(file.numbers[i])) {
            fail_input(path, "point " + std::to_string(i) + ": its " + column + " is " +
                                 exact_text(file.numbers[i]) + ", not a positive distance");
        }
    }
    return file.numbers;
}

/// Returns the radius of the disk around each source that holds an area.
std::vector<double> radii_of_area(const Length& area, const std::vector<Sample>& sources,
                                  const MeshInput& mesh, ProgressLine& progress) {
    const double whole = mesh.prepared.statistics().area;
    progress.begin_stage("measuring disks");
    auto radii =
        disk_radii(mesh.prepared, sources, area.is_percent ? area.in_mesh_units(whole) : area.value,
                   {}, [&](const Progress& state) {
                       progress.update(static_cast<double>(state.decided) / state.candidates, "");
                       return !is_interrupted();
                   });
    progress.clear();
    check_interrupted();
    return take(std::move(radii), mesh.path);
}

NeighbourJob make_job(const NeighbourOptions& options, const Within& within,
                      const std::vector<VertexRange>& vertices, const MeshInput& mesh,
                      std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    NeighbourJob job;
    if (options.source.points.empty()) {
        job.sources = options.among == "sources" && vertices.empty() ? places_of(mesh)
                                                                     : vertices_of(mesh, vertices);
        if (!mesh.face_mask.empty()) {
            keep_masked(mesh, job.sources);
        }
    } else {
        const SampleFile file =
            options.source.read(options.source.points, within.column, mesh, warnings, progress);
        job.sources.points = samples_of(file.rows);
        if (!within.column.empty()) {
            job.radii = radii_in(options.source.points, within.column, file);
        }
    }
    if (within.area) {
        job.radii = radii_of_area(*within.area, job.sources.points, mesh, progress);
    }
    if (within.length) {
        job.within = distance_on_mesh(*within.length, mesh.prepared.statistics());
    }
    if (const std::string path = options.searched(); !path.empty()) {
        job.kind = NeighbourKind::points;
        job.points = samples_of(options.source.read(path, {}, mesh, warnings, progress).rows);
    } else if (options.among == "sources") {
        job.kind = NeighbourKind::sources;
    }
    return job;
}

/// Report of a search that is done, for write_outputs().
struct NeighbourReport {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and points.
    const NeighbourJob& job;
    const NeighbourResult& result;
    const std::string& output;
    bool has_points;     ///< Sources are points, else vertices.
    std::string targets; ///< Name of the targets.

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

struct RowSizes {
    std::uint64_t least, most;
    double mean;
};

RowSizes sizes_of(const NeighbourTable& table) {
    RowSizes sizes{~std::uint64_t{0}, 0, 0};
    for (std::size_t i = 0; i + 1 < table.offsets.size(); ++i) {
        const std::uint64_t size = table.offsets[i + 1] - table.offsets[i];
        sizes.least = std::min(sizes.least, size);
        sizes.most = std::max(sizes.most, size);
    }
    sizes.mean =
        static_cast<double>(table.targets.size()) / static_cast<double>(table.offsets.size() - 1);
    return sizes;
}

/// Returns nothing where neighbours may be any distance away.
std::optional<double> largest_distance(const NeighbourJob& job) {
    if (!job.radii.empty()) {
        return *std::ranges::max_element(job.radii);
    }
    return job.within > 0 ? std::optional(job.within) : std::nullopt;
}

std::string within_text(const NeighbourJob& job) {
    const std::optional<double> distance = largest_distance(job);
    return !distance
               ? "any distance"
               : (job.radii.empty() ? "" : "up to ") + rounded(*distance, 6) + " in mesh units";
}

std::string NeighbourReport::json(double write_seconds) const {
    const RowSizes sizes = sizes_of(result.table);
    Json document{
        {"version", GEODISK_VERSION_STRING},
        {"mesh", mesh_json(mesh)},
        {"warnings", warnings_json(warnings)},
        {"sources",
         {{"kind", has_points ? "points" : "vertices"}, {"count", result.table.sources.size()}}},
        {"targets", targets},
        {"within", json_of(largest_distance(job))},
        {"nearest", job.nearest == 0 ? Json(nullptr) : Json(job.nearest)},
        {"pairs", result.table.targets.size()},
        {"per_source", {{"least", sizes.least}, {"mean", sizes.mean}, {"most", sizes.most}}},
        {"error", result.error},
        {"disks", result.done.run.disks},
        {"windows", result.done.run.windows},
        {"output", output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string NeighbourReport::summary(double write_seconds) const {
    const RowSizes sizes = sizes_of(result.table);
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "sources       "
        << (has_points ? counted(result.table.sources.size(), "point", "points")
                       : counted(result.table.sources.size(), "vertex", "vertices"))
        << '\n'
        << "neighbours    " << grouped(result.table.targets.size()) << " in all, "
        << grouped(sizes.least) << " to " << grouped(sizes.most) << " each, "
        << rounded(sizes.mean, 4) << " on average, among " << targets << '\n'
        << "within        " << within_text(job) << ", exact to " << rounded(result.error, 2) << '\n'
        << search_text(mesh, result.done, write_seconds, output, "searching");
    return out.str();
}

void run_neighbours(const NeighbourOptions& options) {
    const SampleTarget target = neighbour_target(options.out.output, options.out.format);
    const Within within = parsed_within(options);
    const std::vector<VertexRange> vertices = options.source.ranges();
    if (options.mask.is_given() &&
        !(options.source.points.empty() && options.source.vertices.empty())) {
        fail_usage(options.mask.names() + ": all sources are given by " +
                   (options.source.points.empty() ? "--vertices" : "POINTS"));
    }
    constexpr double kMax = 0xffffffffp0;
    const double nearest = options.nearest.empty() ? 0 : parse_count("--nearest", options.nearest);
    const double pairs =
        options.max_pairs.empty() ? 0 : parse_count("--most-pairs", options.max_pairs);
    const RunnerOptions runner = options.run.runner();
    check_tolerance(options.source.tolerance);
    check_files(options);

    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_masked_mesh(options.mesh, progress, options.mask);
    std::vector<MeshWarning> warnings;
    NeighbourJob job = make_job(options, within, vertices, mesh, warnings, progress);
    job.nearest = static_cast<std::uint32_t>(std::min(nearest, kMax));
    job.max_pairs = static_cast<std::uint64_t>(pairs);
    print_warnings(warnings);
    warnings.insert(warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    RunDevice device(options.run.device, runner);
    const NeighbourResult result =
        search_neighbours(job, mesh, device, runner.device_bytes != 0, progress);
    check_validation(device.context());
    const NeighbourReport report{mesh,
                                 warnings,
                                 job,
                                 result,
                                 options.out.output,
                                 !options.source.points.empty(),
                                 options.searched().empty() ? options.among : "points"};
    write_outputs(options.out, "the neighbours", progress, report,
                  [&](AtomicFile& file) { write_neighbours(file, target, result.table); });
}

} // namespace

void add_neighbours_command(Command app) {
    const Command command = app.add_command(
        "neighbours", "Find all vertices or points within a geodesic distance of each\n"
                      "source, and their distances");
    const auto options = std::make_shared<NeighbourOptions>();
    add_mesh_argument(command, options->mesh, "Mesh to search");
    command.add_option("POINTS", options->source.points, "",
                       "Sources: samples of MESH, or points of another program,\n"
                       "put on the nearest face; without it all vertices");
    add_output_argument(command, options->out,
                        "File to write: *.npz (arrays sources, offsets, targets,\n"
                        "distances) or *.csv (source, target, distance)");
    command.add_option("--within", options->within, "R",
                       "Distance along the surface: in mesh units, or 1% of the\n"
                       "diagonal, or the column of POINTS that has one for each;\n"
                       "area:1%: as far as the disk holds so much of the area, and\n"
                       "area:A in square mesh units");
    add_source_options(command, options->source,
                       "Sources are only these vertices, such as 0,5,10-20, or @FILE\n"
                       "with such numbers, separated by blanks or lines");
    command.add_option("--among", options->among, "WHAT",
                       "What to find: vertices (the default), sources (all\n"
                       "others), or the points of a file");
    command.add_option("--nearest", options->nearest, "K",
                       "Keep only the K nearest per source, nearest first, and of\n"
                       "vertices in one place the lowest; without --within, search\n"
                       "as far as needed");
    command.add_option("--most-pairs", options->max_pairs, "N",
                       "Stop if more than N pairs are expected (default 2^30)");
    add_mesh_options(command, options->mesh);
    options->mask.lacking = "there are no sources to find neighbours of";
    add_mask_options(command, options->mask, OptionUse::choosing);
    add_json_option(command, options->out);
    command.add_option("--format", options->out.format, "FORMAT",
                       "Write npz or csv, ignoring the extension of OUT");
    add_quiet_option(command, options->out);
    add_device_options(command, options->run.device);
    add_verbose_option(command, options->run.device);
    add_limit_options(command, options->run);
    command.has_footer(help_footer(kNeighboursExamples));
    command.calls([options] { run_neighbours(*options); });
}

} // namespace geodisk::tools
