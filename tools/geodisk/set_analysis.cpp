#include "geodisk/set_analysis.hpp"

#include <algorithm>
#include <vector>

#include <geodisk/params.hpp>

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
constexpr double kMostProbes = 1e7;

} // namespace

void add_probes_option(Command command, std::string& probes) {
    command.add_option("--probes", probes, "N",
                       "Number of random points to find gaps with (default 10 per\n"
                       "sample, at least 20,000)");
}

std::uint32_t probes_for(const std::string& probes, std::size_t samples) {
    if (!probes.empty()) {
        const double count = parse_count("--probes", probes);
        if (count > kMostProbes) {
            fail_usage("--probes takes at most 1e7");
        }
        return static_cast<std::uint32_t>(count);
    }
    return static_cast<std::uint32_t>(
        std::clamp(kProbesPerSample * static_cast<double>(samples), kFewestProbes, kMostProbes));
}

SetAnalysis analyze_disks(const MeshInput& mesh, std::span<const SurfaceDisk> disks,
                          const std::string& probes, std::uint64_t seed, ProgressLine& progress) {
    SetAnalysis set;
    set.samples = disks.size();
    const auto [least, most] = std::minmax_element(
        disks.begin(), disks.end(),
        [](const SurfaceDisk& a, const SurfaceDisk& b) { return a.radius < b.radius; });
    set.min_distance = 2 * most->radius;
    if (least->radius == most->radius) {
        SampleParams params;
        params.face_mask = mesh.face_mask;
        set.rho = packing_density(effective_area(mesh.prepared, params), set.min_distance,
                                  static_cast<double>(set.samples));
    }
    std::vector<std::uint32_t> faces;
    faces.reserve(set.samples);
    for (const SurfaceDisk& disk : disks) {
        faces.push_back(disk.face);
    }
    set.bare_components = parts_without(mesh.prepared, faces, mesh.face_mask).count;
    progress.begin_stage("measuring distances");
    set.found = analysis::measure(mesh.prepared, mesh.face_mask, disks,
                                  probes_for(probes, set.samples), seed, [&](double part) {
                                      check_interrupted();
                                      progress.update(part, grouped(set.samples) + " samples");
                                  });
    progress.clear();
    return set;
}

} // namespace geodisk::tools
