#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <geodisk/nearest.hpp>
#include <geodisk/version.hpp>

#include "files/samples/cell_file.hpp"
#include "files/samples/gifti_writer.hpp"
#include "files/samples/sample_fields.hpp"
#include "files/samples/sample_format.hpp"
#include "geodisk/cell_run.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/scene_frame.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kCellsExamples[] = {
    "geodisk cells bunny.ply points.ply -o areas.csv",
    "geodisk cells bunny.ply points.ply -o areas.ply --dual remeshed.obj",
    "geodisk cells lh.white points.ply -o areas.csv --labels lh.cells.label.gii",
    "geodisk cells scan.ply points.ply -o areas.csv --dual remeshed.ply --attributes all",
    "geodisk cells bunny.ply points.ply -o areas.csv --split cells.vtp --outlines lines.obj",
};

struct CellOptions {
    MeshOptions mesh;
    MaskOptions mask;
    OutputOptions out;
    RunOptions run;
    std::string samples, dual, labels, split, outlines, tolerance;

    bool has_geometry() const { return !split.empty() || !outlines.empty(); }
};

void check_files(const CellOptions& options) {
    std::vector<NamedFile> read{{"the samples read", options.samples}};
    options.mesh.add_files(read, "the mesh");
    options.mask.add_files(read);
    if (!options.dual.empty()) {
        dual_format(options.dual);
    }
    if (!options.labels.empty() && !options.labels.ends_with(".label.gii")) {
        fail_usage(options.labels + ": labels of vertices are written as *.label.gii");
    }
    if (!options.split.empty()) {
        cell_format(options.split, "meshes of cells");
    }
    if (!options.outlines.empty()) {
        cell_format(options.outlines, "outlines of cells");
    }
    const std::vector<NamedFile> further{{"the dual graph", options.dual},
                                         {"the labels", options.labels},
                                         {"the mesh of cells", options.split},
                                         {"the outlines", options.outlines}};
    check_outputs(options.out, "the samples", read, nullptr, further);
    for (const NamedFile& file : further) {
        if (!file.path.empty()) {
            check_writable(file.path);
        }
    }
    const std::vector<std::string> columns{kAreaColumn};
    check_columns(options.out.target(), columns);
    options.out.check_scene(false);
}

/// Checks that the outputs can hold the attributes. With `all`, one called area is left out.
void check_attributes(const CellOptions& options, MeshInput& mesh) {
    std::vector<MeshField>& fields = mesh.file.fields;
    const auto area = std::ranges::find(fields, kAreaColumn, &MeshField::name);
    if (area != fields.end()) {
        if (!options.mesh.fields.all) {
            fail_usage("--attributes: area is the column of the areas of cells; name the other "
                       "attributes");
        }
        fields.erase(area);
        print_warning(options.mesh.mesh + ": the attribute 'area' has the name of a column of " +
                      "samples with cells, so it is left out");
    }
    if (!options.dual.empty()) {
        check_dual(dual_format(options.dual), mesh.dimension(), fields);
    }
}

/// Returns the header of the samples in the file, with their areas.
SampleHeader header_with_areas(const CellOptions& options, const SampleHeader& source,
                               const SurfaceCells& cells) {
    SampleHeader header = source;
    if (header.find("version") == nullptr) {
        header.entries.insert(
            header.entries.begin(),
            {{"version", "geodisk " GEODISK_VERSION_STRING}, {"mesh", options.mesh.mesh}});
    }
    std::erase_if(header.entries, [](const auto& entry) {
        return entry.first == "area_error" || entry.first == "area_unreached" ||
               entry.first == "attributes";
    });
    const HeaderEntries record = options.out.record.entries();
    header.entries.insert(header.entries.end(), record.begin(), record.end());
    header.entries.emplace_back("area_error", exact_text(cells.area_error));
    if (cells.unreached > 0) {
        header.entries.emplace_back("area_unreached", exact_text(cells.unreached));
    }
    return header;
}

/// Writes the cell of each vertex, whose label is one more than its sample; 0 is none.
void write_labels(AtomicFile& file, const std::string& mesh, std::size_t samples,
                  const std::vector<std::uint32_t>& nearest) {
    constexpr double kGoldenTurn = 0.6180339887498949; // Spreads hues over the circle.
    std::vector<GiftiLabel> labels{{0, "???", {}}};
    for (std::size_t i = 0; i < samples; ++i) {
        GiftiLabel& label = labels.emplace_back();
        label.key = static_cast<std::int32_t>(i + 1);
        label.name = "sample " + std::to_string(i);
        for (std::size_t k = 0; k < 3; ++k) {
            const double hue = kGoldenTurn * static_cast<double>(i) + static_cast<double>(k) / 3;
            const double place = 6 * (hue - std::floor(hue)); // Red, green and blue, a third apart.
            label.colour[k] = std::clamp(std::abs(place - 3) - 1, 0.0, 1.0);
        }
        label.colour[3] = 1;
    }
    std::vector<std::int32_t> keys;
    keys.reserve(nearest.size());
    for (const std::uint32_t sample : nearest) {
        keys.push_back(sample == NearestSample::kNone ? 0 : static_cast<std::int32_t>(sample + 1));
    }
    write_gifti_labels(file, keys, labels,
                       {{"version", "geodisk " GEODISK_VERSION_STRING}, {"mesh", mesh}});
}

/// Report of cells that are found, for write_outputs().
struct CellReport {
    const CellOptions& options;
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and samples.
    const CellResult& result;
    std::optional<SceneFrame> scene;

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

/// Returns a path, or null without one.
Json path_json(const std::string& path) {
    return path.empty() ? Json(nullptr) : Json(path);
}

double manifold_part(const DualReport& dual) {
    return dual.triangles == 0
               ? 1
               : static_cast<double>(dual.manifold) / static_cast<double>(dual.triangles);
}

Json angles_json(const CellReport& report) {
    const TriangleAngles& angles = report.result.angles;
    if (report.result.points.empty() || report.result.cells.triangles.empty()) {
        return nullptr;
    }
    return {{"least", angles.least},
            {"largest", angles.largest},
            {"part_30_to_120", angles.part_inside}};
}

Json dual_json(const CellReport& report) {
    if (report.options.dual.empty()) {
        return nullptr;
    }
    const DualReport& dual = report.result.cells.dual;
    return {{"file", report.options.dual},
            {"vertices", dual.vertices},
            {"edges", dual.edges},
            {"triangles", dual.triangles},
            {"manifold_triangles", dual.manifold},
            {"euler", dual.euler},
            {"mesh_euler", dual.mesh_euler},
            {"angles", angles_json(report)}};
}

std::string dual_lines(const CellReport& report) {
    const DualReport& dual = report.result.cells.dual;
    std::ostringstream out;
    out << "dual          " << counted(dual.triangles, "triangle", "triangles") << ", "
        << rounded(100 * manifold_part(dual), 4) << "% manifold; Euler characteristic "
        << dual.euler << ", of the mesh " << dual.mesh_euler << '\n';
    if (!angles_json(report).is_null()) {
        const TriangleAngles& angles = report.result.angles;
        out << "angles        " << rounded(angles.least, 3) << " to " << rounded(angles.largest, 3)
            << " degrees; " << rounded(100 * angles.part_inside, 4)
            << "% of the triangles within 30 to 120\n";
    }
    out << "dual file     " << one_line(report.options.dual) << '\n';
    return out.str();
}

std::string CellReport::json(double write_seconds) const {
    const SurfaceCells& cells = result.cells;
    const auto [least, largest] = std::ranges::minmax(cells.areas);
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(mesh)},
                  {"warnings", warnings_json(warnings)},
                  {"samples", cells.areas.size()},
                  {"areas",
                   {{"least", least},
                    {"largest", largest},
                    {"error", cells.area_error},
                    {"unreached", cells.unreached}}},
                  {"error", cells.distance_error},
                  {"dual", dual_json(*this)},
                  {"labels", path_json(options.labels)},
                  {"split", path_json(options.split)},
                  {"outlines", path_json(options.outlines)},
                  {"disks", cells.report.disks},
                  {"windows", cells.report.windows},
                  {"scene", scene_json(scene)},
                  {"output", options.out.output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string CellReport::summary(double write_seconds) const {
    const SurfaceCells& cells = result.cells;
    const auto [least, largest] = std::ranges::minmax(cells.areas);
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "cells         " << grouped(cells.areas.size())
        << ", with areas from " << rounded(least, 4) << " to " << rounded(largest, 4)
        << ", exact to " << rounded(cells.area_error, 2) << '\n';
    if (cells.unreached > 0) {
        out << "no sample     in parts of the mesh with an area of " << rounded(cells.unreached, 4)
            << '\n';
    }
    if (!options.dual.empty()) {
        out << dual_lines(*this);
    }
    const auto add_file = [&](const char* title, const std::string& path) {
        out << (path.empty() ? "" : title + one_line(path) + '\n');
    };
    add_file("labels file   ", options.labels);
    add_file("split mesh    ", options.split);
    add_file("outlines      ", options.outlines);
    out << search_text(mesh, result.done, write_seconds, options.out.output, "finding cells")
        << scene_line(scene);
    return out.str();
}

void run_cells_command(CellOptions options) {
    options.mesh.fields = options.out.record.fields();
    const RunnerOptions runner = options.run.runner();
    check_tolerance(options.tolerance);
    check_files(options);

    ProgressLine progress(options.out.quiet);
    MeshInput mesh = load_masked_mesh(options.mesh, progress, options.mask);
    check_dimension(options.out.target(), mesh.dimension());
    check_attributes(options, mesh);
    if (options.has_geometry() && mesh.dimension() != 3) {
        fail_usage(std::string(options.split.empty() ? "--outlines" : "--split") +
                   " needs a mesh with 3 coordinates per vertex");
    }
    std::vector<MeshWarning> warnings;
    SampleFile file =
        read_samples_silently_on(options.samples, mesh, options.tolerance, warnings, progress);
    if (file.rows.empty()) {
        fail_input(options.samples, "has no samples");
    }
    for (SampleRow& row : file.rows) {
        mesh.place(row);
    }
    print_warnings(warnings);
    warnings.insert(warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    RunDevice device(options.run.device, runner);
    const CellResult result =
        run_cells(file.rows, !options.dual.empty(), mesh, device, runner.device_bytes, progress);
    std::vector<std::uint32_t> at_vertices;
    CutCells cuts;
    if (options.has_geometry() || !options.labels.empty()) {
        const NearestSamples nearest =
            find_nearest(file.rows, mesh, device, runner.device_bytes, progress);
        if (!options.labels.empty()) {
            at_vertices = samples_at_vertices(nearest, mesh);
        }
        if (options.has_geometry()) {
            cuts = cut_along_cells(nearest, file.rows.size(), mesh, progress);
        }
    }
    check_validation(device.context());
    print_precision_note(options.out, file.rows, mesh.dimension());
    const SampleHeader header = header_with_areas(options, file.header, result.cells);
    const std::vector<SampleField> attributes = sample_fields(mesh.file, file.rows);
    std::vector<SampleField> fields{area_field(result.cells)};
    fields.insert(fields.end(), attributes.begin(), attributes.end());
    const std::vector<FurtherFile> further{
        {options.dual,
         [&](AtomicFile& dual) {
             write_dual(dual, dual_format(options.dual), dual_mesh(result, mesh, attributes));
         }},
        {options.labels,
         [&](AtomicFile& labels) {
             write_labels(labels, options.mesh.mesh, file.rows.size(), at_vertices);
         }},
        {options.split,
         [&](AtomicFile& split) { write_cell_mesh(split, cell_format(options.split, ""), cuts); }},
        {options.outlines,
         [&](AtomicFile& outlines) {
             write_cell_outlines(outlines, cell_format(options.outlines, ""), cuts);
         }},
    };
    const CellReport report{options, mesh, warnings, result,
                            scene_frame(options.out, options.mesh, mesh)};
    write_outputs(
        options.out, "the samples", progress, report,
        [&](AtomicFile& samples) {
            write_samples(samples, target_in(options.out, report.scene), header, file.rows,
                          mesh.dimension(), {file.extra, fields});
        },
        further);
}

} // namespace

void add_cells_command(Command app) {
    const Command command =
        app.add_command("cells", "Compute the area of the geodesic Voronoi cell of each sample,\n"
                                 "and the dual mesh");
    const auto options = std::make_shared<CellOptions>();
    add_mesh_argument(command, options->mesh, "Mesh that the samples lie on");
    command
        .add_option("SAMPLES", options->samples, "",
                    "Samples of MESH, or points of another program, put on the\n"
                    "nearest face")
        .required();
    add_output_argument(command, options->out,
                        wrapped("File to write: the samples with a column `area`, as " +
                                listed_formats(&FormatFacts::has_columns, "*.")));
    command.add_option("--dual", options->dual, "FILE",
                       "Write the dual graph too: *.obj, *.ply or *.vtp (samples as\n"
                       "vertices, a triangle where three cells meet) or *.npz (arrays\n"
                       "points, edges, triangles)");
    command.add_option("--labels", options->labels, "FILE",
                       "Write the cell of each vertex of MESH too, as *.label.gii\n"
                       "(GIFTI): the row of its sample plus 1; 0 if no path leads to one");
    command.add_option("--split", options->split, "FILE",
                       "Write the mesh too, cut along the borders of cells: *.vtp, *.ply\n"
                       "(faces with the numbers sample and face) or *.obj (a group for\n"
                       "each sample)");
    command.add_option("--outlines", options->outlines, "FILE",
                       "Write the borders of cells too, as lines: *.vtp, *.ply or *.obj");
    add_attributes_option(command, options->out.record);
    add_mesh_options(command, options->mesh);
    options->mask.lacking = "no cell has an area";
    add_mask_options(command, options->mask, OptionUse::choosing);
    add_tolerance_option(command, options->tolerance);
    add_output_options(command, options->out);
    add_device_options(command, options->run.device);
    add_verbose_option(command, options->run.device);
    add_limit_options(command, options->run);
    command.has_footer(help_footer(kCellsExamples));
    command.calls([options] { run_cells_command(*options); });
}

} // namespace geodisk::tools
