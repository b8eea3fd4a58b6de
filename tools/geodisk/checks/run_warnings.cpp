#include "geodisk/checks/run_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geodisk/outputs/outputs.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Part of a count that may be missed without a word, as CountSearch has it.
constexpr double kTolerance = 0.05;
/// Smallest share of the area without samples that is worth a warning.
constexpr double kLeastShare = 0.01;

std::string percent(double share) {
    return rounded(100 * share, 2) + " % of the area";
}

/// Where a count chooses the distance, or stops the darts that --throws bounds.
void check_count(const SampleJob& job, const MeshInput& mesh, std::uint64_t samples,
                 std::vector<MeshWarning>& warnings) {
    const auto found = static_cast<double>(samples);
    if (const std::string text = shortfall(job.method, samples); !text.empty()) {
        warnings.push_back(
            {"count_missed", job.method.stop_count - samples, "", text, job.mesh.mesh});
    }
    const double miss = std::abs(found - job.wanted_count);
    if (job.wanted_count > 0 &&
        miss > std::max(kTolerance * job.wanted_count, std::min(1.0, job.wanted_count / 4))) {
        const std::uint64_t parts = mesh.prepared.statistics().components;
        warnings.push_back(
            {"count_missed", static_cast<std::uint64_t>(miss), "",
             counted(samples, "sample", "samples") + " instead of " +
                 grouped(static_cast<std::uint64_t>(job.wanted_count)) +
                 ": no distance that was tried came nearer" +
                 (parts > 1 ? "; each of the " + grouped(parts) + " parts has samples of its own"
                            : ""),
             job.mesh.mesh});
    }
}

} // namespace

std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result) {
    std::vector<MeshWarning> warnings;
    const std::uint64_t samples = result.rows.size();
    check_count(job, mesh, samples, warnings);
    const BareParts& bare = result.bare;
    if (bare.area_share >= kLeastShare) {
        warnings.push_back({"bare_parts", bare.count, "",
                            counted(bare.count, "part", "parts") + " of the mesh, " +
                                percent(bare.area_share) + (bare.count == 1 ? ", has" : ", have") +
                                " no sample; ask for more samples or a smaller distance",
                            job.mesh.mesh});
    }
    const std::uint64_t parts = mesh.prepared.statistics().components;
    if (job.wanted_count == 0 && job.method.stop_count == 0 && job.method.throws == 0 &&
        samples > 0 && samples + bare.count <= parts) {
        warnings.push_back(
            {"single_samples", samples, "",
             (parts == 1 ? "there is a single sample" : "no part has more than one sample") +
                 std::string(": the minimum distance of ") +
                 rounded(result.params.min_distance, 6) +
                 (parts == 1 ? " is larger than the mesh has room for"
                             : " is larger than the parts have room for"),
             job.mesh.mesh});
    }
    return warnings;
}

std::string shortfall(const Method& method, std::uint64_t samples) {
    return samples >= method.stop_count
               ? ""
               : "only " + grouped(samples) + " of " + grouped(method.stop_count) +
                     " samples found room before the darts ran out; lower --count or the distance, "
                     "or raise --throws";
}

void print_warnings(const std::vector<MeshWarning>& warnings) {
    for (const MeshWarning& warning : warnings) {
        print_warning(warning.file + ": " + warning.message);
    }
}

} // namespace geodisk::tools
