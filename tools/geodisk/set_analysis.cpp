#include "geodisk/set_analysis.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include <geodisk/params.hpp>

#include "geodisk/options/class_options.hpp"
#include "geometry/mesh_parts.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr double kProbesPerSample = 10;
constexpr double kFewestProbes = 20000;
constexpr double kMaxProbes = 1e7;

/// Returns the packing density; nothing where radii vary otherwise than by class.
std::optional<double> rho_of(const MeshInput& mesh, std::span<const SurfaceDisk> disks,
                             const ClassDistances& classes, double min_distance) {
    const auto [least, most] = std::ranges::minmax(disks, {}, &SurfaceDisk::radius);
    if (classes.count == 0 && least.radius != most.radius) {
        return std::nullopt;
    }
    std::vector<float> factors;
    for (const double distance : classes.distances) {
        factors.push_back(class_factor(distance / min_distance));
    }
    SampleParams params;
    params.face_mask = mesh.face_mask;
    params.class_factors = factors;
    return packing_density(mesh.effective_area(params), min_distance,
                           static_cast<double>(disks.size()));
}

/// Returns disks on the parts of split faces, where there are such.
std::vector<SurfaceDisk> disks_on_sampled(const MeshInput& mesh,
                                          std::span<const SurfaceDisk> of_file) {
    std::vector<SurfaceDisk> disks(of_file.begin(), of_file.end());
    for (SurfaceDisk& disk : disks) {
        if (mesh.split) {
            const Sample at = mesh.on_sampled(
                {disk.face,
                 {static_cast<float>(1 - disk.weight1 - disk.weight2),
                  static_cast<float>(disk.weight1), static_cast<float>(disk.weight2)}});
            disk.face = at.face;
            disk.weight1 = double{at.weights[1]};
            disk.weight2 = double{at.weights[2]};
        }
    }
    return disks;
}

/// Measures samples, not none, but no class alone.
SetAnalysis measure_disks(const MeshInput& mesh, std::span<const SurfaceDisk> disks,
                          const ClassDistances& classes, std::uint32_t probes, std::uint64_t seed,
                          ProgressLine& progress) {
    SetAnalysis set;
    set.samples = disks.size();
    set.min_distance = classes.count > 0
                           ? std::ranges::max(classes.distances)
                           : 2 * std::ranges::max(disks, {}, &SurfaceDisk::radius).radius;
    set.rho = rho_of(mesh, disks, classes, set.min_distance);
    std::vector<std::uint32_t> faces;
    faces.reserve(set.samples);
    for (const SurfaceDisk& disk : disks) {
        faces.push_back(disk.face);
    }
    set.bare_components = parts_without(mesh.sampled(), faces, mesh.face_mask).count;
    progress.begin_stage("measuring distances");
    const auto tell = [&](double part) {
        check_interrupted();
        progress.update(part, grouped(set.samples) + " samples");
    };
    set.found =
        analysis::measure(mesh.sampled(), mesh.face_mask, disks, probes, seed, tell, classes);
    return set;
}

} // namespace

void add_probes_option(Command command, std::string& probes) {
    command.add_option("--probes", probes, "N",
                       "Number of random points to find gaps with (default 10 per\n"
                       "sample, at least 20,000)");
}

std::uint32_t probes_for(const std::string& probes, std::size_t samples) {
    if (!probes.empty()) {
        const double count = parse_count("--probes", probes);
        if (count > kMaxProbes) {
            fail_usage("--probes takes at most 1e7");
        }
        return static_cast<std::uint32_t>(count);
    }
    return static_cast<std::uint32_t>(
        std::clamp(kProbesPerSample * static_cast<double>(samples), kFewestProbes, kMaxProbes));
}

SetAnalysis analyze_disks(const MeshInput& mesh, const SampleDisks& samples,
                          const std::string& probes, std::uint64_t seed, ProgressLine& progress) {
    const std::vector<SurfaceDisk> disks = disks_on_sampled(mesh, samples.disks);
    const ClassDistances& classes = samples.classes;
    SetAnalysis set =
        measure_disks(mesh, disks, classes, probes_for(probes, disks.size()), seed, progress);
    for (std::uint32_t number = 0; number < classes.count; ++number) {
        std::vector<SurfaceDisk> own;
        std::ranges::copy_if(disks, std::back_inserter(own),
                             [&](const SurfaceDisk& disk) { return disk.kind == number + 1; });
        SetAnalysis& one = set.classes.emplace_back();
        if (!own.empty()) {
            one = measure_disks(mesh, own, {}, set.found.probes, seed, progress);
        }
        one.min_distance = classes.of(number, number);
        one.found.probes = set.found.probes;
        one.found.uncovered = set.found.rooms[number].uncovered;
        one.found.largest_gap = set.found.rooms[number].largest_gap;
    }
    progress.clear();
    return set;
}

} // namespace geodisk::tools
