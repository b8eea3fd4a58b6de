#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/evenness.hpp"
#include "analysis/surface_statistics.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_classes.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/analysis_report.hpp"
#include "geodisk/set_analysis.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kAnalyzeExamples[] = {
    "geodisk analyze bunny.obj points.csv",
    "geodisk analyze bunny.obj first.csv second.csv --json analysis.json",
};

using analysis::Evenness;

/// Samples of a set that a region should hold.
constexpr double kPerRegion = 20;
constexpr std::uint32_t kMaxRegions = 32;

struct AnalyzeOptions {
    MeshOptions mesh;
    MaskOptions mask;
    std::vector<std::string> samples;
    DistanceOptions distance;
    std::string probes, seed = "0", tolerance;
    OutputOptions out; ///< No samples.
};

/// Regions of the mesh, and how many samples of each set they hold.
class RegionCounts {
  public:
    /// None where there are no coordinates to cut by.
    void add(const MeshInput& mesh, std::span<const SampleRow> rows) {
        if (mesh.dimension() == 0) {
            return;
        }
        if (counts_.empty()) {
            cut(mesh, static_cast<double>(rows.size()));
        }
        std::vector<double>& counts = counts_.emplace_back(regions_.areas.size(), 0);
        for (const SampleRow& row : rows) {
            counts[regions_.of_face[mesh.sampled_of(row).face]] += 1;
        }
    }

    std::optional<Evenness> test() const {
        return analysis::test_evenness(counts_, regions_.areas);
    }

  private:
    void cut(const MeshInput& mesh, double samples) {
        const auto& edges = mesh.sampled().half_edges();
        const BisectedMesh* const parts = mesh.split ? &mesh.split->faces.parts() : nullptr;
        const auto& triangles = parts ? parts->triangles() : mesh.file.triangles;
        const auto& positions = parts ? parts->positions() : mesh.file.positions;
        std::vector<double> areas, centers;
        areas.reserve(edges.size() / 3);
        for (std::uint32_t face = 0; 3 * std::size_t{face} < edges.size(); ++face) {
            const HalfEdge& edge = edges[std::size_t{3} * face];
            const bool is_in = mesh.face_mask.empty() || mesh.face_mask[face] != 0;
            areas.push_back(is_in ? edge.length * edge.apex_y / 2 : 0);
            const auto at = [&](std::size_t corner, std::uint32_t axis) {
                return positions[std::size_t{triangles[3 * std::size_t{face} + corner]} *
                                     mesh.dimension() +
                                 axis];
            };
            for (std::uint32_t axis = 0; axis < mesh.dimension(); ++axis) {
                centers.push_back((at(0, axis) + at(1, axis) + at(2, axis)) / 3);
            }
        }
        const auto count = std::bit_floor(
            static_cast<std::uint32_t>(std::clamp(samples / kPerRegion, 1.0, 1.0 * kMaxRegions)));
        regions_ = analysis::make_regions(centers, mesh.dimension(), areas, count);
    }

    analysis::Regions regions_;
    std::vector<std::vector<double>> counts_;
};

SetAnalysis analyze_set(const AnalyzeOptions& options, const std::string& path,
                        const MeshInput& mesh, RegionCounts& regions,
                        std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    const SampleFile samples =
        read_samples_exactly_on(path, mesh, options.tolerance, warnings, progress);
    if (samples.rows.empty()) {
        fail_input(path, "has no samples to analyze");
    }
    check_class_options(samples, options.mask, {});
    if (const auto masked = masked_samples(samples, mesh); !masked.empty()) {
        fail_input(path, counted(masked.size(), "sample is", "samples are") + " on faces that " +
                             options.mask.names() + " left out, first sample " +
                             std::to_string(masked.front()));
    }
    const SampleDisks disks =
        sample_disks(samples, mesh, options.distance.parsed(), warnings, progress);

    SetAnalysis set =
        analyze_disks(mesh, disks, options.probes, parse_seed("--seed", options.seed), progress);
    set.path = path;
    regions.add(mesh, samples.rows);
    return set;
}

void run_analyze(const AnalyzeOptions& options) {
    options.distance.parsed(); // Before the files are read.
    check_tolerance(options.tolerance);
    parse_seed("--seed", options.seed);
    options.mask.check(kMaxClasses);
    probes_for(options.probes, 1);
    std::vector<NamedFile> read;
    for (const std::string& samples : options.samples) {
        read.push_back({"the samples", samples});
    }
    options.mesh.add_files(read, "the mesh");
    options.mask.add_files(read);
    check_outputs(options.out, "", read);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress, {}, options.mask);
    std::vector<MeshWarning> warnings = mesh.warnings;
    std::vector<SetAnalysis> sets;
    RegionCounts regions;
    for (const std::string& path : options.samples) {
        sets.push_back(analyze_set(options, path, mesh, regions, warnings, progress));
    }
    const Analysis analysis{mesh, warnings, sets, are_alike(sets) ? regions.test() : std::nullopt};
    publish(options.out, report_json(analysis), report_text(analysis));
}

} // namespace

void add_analyze_command(Command app) {
    const Command command =
        app.add_command("analyze", "Measure spacing and evenness of samples (exact, CPU only)");
    const auto options = std::make_shared<AnalyzeOptions>();
    add_mesh_argument(command, options->mesh, "Mesh that the samples were made on");
    command
        .add_option("SAMPLES", options->samples, "",
                    help_of_input("Samples to analyze",
                                  ". Give several files with different seeds "
                                  "to test whether samples are spread evenly"))
        .required();
    add_distance_options(command, options->distance);
    add_probes_option(command, options->probes);
    command.add_option("--seed", options->seed, "S", "Seed of the random points").shows_default();
    add_tolerance_option(command, options->tolerance);
    add_mesh_options(command, options->mesh);
    add_mask_options(command, options->mask, OptionUse::checking);
    add_json_option(command, options->out);
    add_quiet_option(command, options->out, "No progress and no result");
    command.has_footer(help_footer(kAnalyzeExamples));
    command.calls([options] { run_analyze(*options); });
}

} // namespace geodisk::tools
