#include "geodisk/checks/run_warnings.hpp"

#include <algorithm>
#include <string>

#include "geodisk/outputs/outputs.hpp"
#include "geometry/set_warnings.hpp"

namespace geodisk::tools {

std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result, bool lacks_features) {
    std::vector<MeshWarning> warnings =
        set_warnings({.samples = result.count(),
                      .existing = result.existing,
                      .avoids = result.avoided > 0 || result.avoided_length > 0,
                      .min_distance = result.params.min_distance * mesh.distance_part,
                      .wanted_count = job.wanted_count.samples,
                      .cut = result.done.cut,
                      .stop_count = job.method.stop_count,
                      .has_darts = job.method.darts > 0,
                      .lacks_features = lacks_features ? *job.features : 0,
                      .bare = result.bare});
    for (std::uint32_t number = 0; number < job.classes.count && result.count() > 0; ++number) {
        if (std::ranges::find(result.classes, number) == result.classes.end()) {
            warnings.push_back(
                {"empty_class", 1, "", "class " + std::to_string(number) + " has no sample", ""});
        }
    }
    for (MeshWarning& warning : warnings) {
        warning.file = job.mesh.mesh;
    }
    return warnings;
}

void print_warnings(const std::vector<MeshWarning>& warnings) {
    for (const MeshWarning& warning : warnings) {
        print_warning((warning.file.empty() ? "" : warning.file + ": ") + warning.message);
    }
}

} // namespace geodisk::tools
