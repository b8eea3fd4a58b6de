#include "geodisk/spectrum_run.hpp"

#include <algorithm>
#include <cstdint>

#include "geodisk/outputs/outputs.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

using analysis::Laplacian;
using analysis::ManifoldHarmonics;

constexpr std::size_t kHarmonics = 1000;
/// Maximum of harmonics, as a part of the vertices: the waves of more harmonics have hardly three
/// vertices each.
constexpr double kMaxOfVertices = 0.1;

void check_on_surface(std::span<const analysis::PlacedSamples> sets, const Laplacian& laplacian) {
    for (const analysis::PlacedSamples& samples : sets) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (laplacian.nodes[std::size_t{3} * samples[i].face] == Laplacian::kNoNode) {
                throw UserError(ExitCode::bad_input,
                                "sample " + std::to_string(i) + " lies on triangle " +
                                    std::to_string(samples[i].face) + ", which is a single point");
            }
        }
    }
}

std::size_t count_for(const std::string& text, const std::string& mesh_path,
                      const Laplacian& laplacian, const ManifoldHarmonics& harmonics,
                      std::vector<MeshWarning>& warnings) {
    std::size_t count = parse_harmonics(text);
    if (text.empty()) {
        count = std::min(count, harmonics.count());
    }
    if (count > harmonics.count()) {
        fail_usage("--harmonics: " + mesh_path + " has " +
                   counted(laplacian.size(), "vertex", "vertices") + ", so only " +
                   counted(harmonics.count(), "harmonic", "harmonics"));
    }
    if (static_cast<double>(count) > kMaxOfVertices * laplacian.size()) {
        warnings.push_back({"coarse_mesh", count, "",
                            grouped(count) + " harmonics of " +
                                counted(laplacian.size(), "vertex", "vertices") +
                                ": the shortest waves are those of the triangles rather than of "
                                "the surface; subdivide the mesh before sampling",
                            ""});
        print_warning(mesh_path + ": " + warnings.back().message);
    }
    return count;
}

} // namespace

std::size_t parse_harmonics(const std::string& text) {
    return text.empty() ? kHarmonics : static_cast<std::size_t>(parse_count("--harmonics", text));
}

SpectrumRun compute_spectrum_on(const MeshInput& mesh,
                                std::span<const analysis::PlacedSamples> sets,
                                const std::string& harmonics, std::vector<MeshWarning>& warnings,
                                ProgressLine& progress) {
    progress.begin_stage("preparing the waves of the surface");
    const Stopwatch watch;
    const Laplacian laplacian = analysis::make_laplacian(mesh.prepared, mesh.file.triangles);
    check_on_surface(sets, laplacian);
    const ManifoldHarmonics all(laplacian);
    progress.clear();
    const std::size_t count = count_for(harmonics, mesh.path, laplacian, all, warnings);
    const auto [seconds, bytes] = all.cost(count);
    const std::string detail =
        "about " + seconds_text(seconds) + " and " + size_text(static_cast<std::uint64_t>(bytes));
    progress.begin_stage("computing " + counted(count, "harmonic", "harmonics"));
    SpectrumRun run{analysis::compute_spectrum(laplacian, all, count, sets,
                                               [&](double part) {
                                                   check_interrupted();
                                                   progress.update(part, detail);
                                               }),
                    0, seconds, bytes};
    progress.clear();
    run.seconds = watch.seconds();
    return run;
}

} // namespace geodisk::tools
