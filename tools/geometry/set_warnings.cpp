#include "geometry/set_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Part of a count that may be missed without a word, as CountSearch has it.
constexpr double kTolerance = 0.05;
/// Smallest share of the area without samples that is worth a warning.
constexpr double kMinShare = 0.01;

std::string percent(double share) {
    return rounded(100 * share, 2) + " % of the area";
}

/// Returns what to say if candidates ran out before there were as many samples as asked for; else
/// "".
std::string shortfall(const SampledSet& set) {
    if (set.samples >= set.stop_count) {
        return "";
    }
    return "only " + grouped(set.samples) + " of " + grouped(set.stop_count) +
           " samples fit before the " + (set.has_darts ? "darts" : "pool") +
           " ran out; ask for fewer samples, lower the distance, or raise " +
           (set.has_darts ? "--darts" : "--pool-ratio");
}

/// Checks a count that chooses the distance, or stops the darts.
void check_count(const SampledSet& set, std::vector<MeshWarning>& warnings) {
    if (std::string text = shortfall(set); !text.empty()) {
        warnings.push_back({"count_missed", set.stop_count - set.samples, "", std::move(text), ""});
    }
    const std::uint64_t found = set.samples + set.cut;
    const double miss = std::abs(static_cast<double>(found) - set.wanted_count);
    if (set.wanted_count > 0 &&
        miss > std::max(kTolerance * set.wanted_count, std::min(1.0, set.wanted_count / 4))) {
        const std::string reason = set.bare.parts > 1 ? "; distances count within each of the " +
                                                            grouped(set.bare.parts) + " parts only"
                                                      : "";
        const std::string kept =
            set.cut > 0 ? ". Just the first " + grouped(set.samples) + " are kept" : "";
        warnings.push_back({"count_missed", static_cast<std::uint64_t>(miss), "",
                            counted(found, "sample", "samples") + " instead of " +
                                grouped(static_cast<std::uint64_t>(set.wanted_count)) +
                                ": no distance tried came closer" + reason + kept,
                            ""});
    }
}

/// Why there is no new sample.
std::string no_room_text(const SampledSet& set) {
    if (set.existing == 0) {
        return "no sample fits outside the points to avoid; lower their radii";
    }
    return std::string("no new sample fits beside the existing ones") +
           (set.avoids ? " and the points to avoid; lower the distance or the radii"
                       : "; lower the distance");
}

} // namespace

std::vector<MeshWarning> set_warnings(const SampledSet& set) {
    std::vector<MeshWarning> warnings;
    check_count(set, warnings);
    if (set.lacks_features > 0) {
        warnings.push_back({"no_features", 1, "",
                            "no edge where samples may lie turns by more than " +
                                rounded(set.lacks_features, 6) +
                                " degrees or is a border, so there are no features",
                            ""});
    }
    const bool has_all = set.stop_count > 0 && set.samples >= set.stop_count;
    if (set.samples == set.existing && (set.existing > 0 || set.avoids) && !has_all) {
        warnings.push_back({"no_new_samples", 1, "", no_room_text(set), ""});
        return warnings;
    }
    const BareParts& bare = set.bare;
    if (bare.area_share >= kMinShare) {
        warnings.push_back({"bare_parts", bare.count, "",
                            counted(bare.count, "part", "parts") + " of the mesh, " +
                                percent(bare.area_share) + (bare.count == 1 ? ", has" : ", have") +
                                " no sample; ask for more samples or a smaller distance",
                            ""});
    }
    const bool is_full = set.wanted_count == 0 && set.stop_count == 0 && !set.has_darts;
    if (is_full && set.samples > 0 && set.samples + bare.count <= bare.parts) {
        warnings.push_back(
            {"single_samples", set.samples, "",
             (bare.parts == 1 ? "there is a single sample" : "no part has more than one sample") +
                 std::string(": the minimum distance of ") + rounded(set.min_distance, 6) +
                 " is larger than the " + (bare.parts == 1 ? set.domain + " has" : "parts have") +
                 " room for",
             ""});
    }
    return warnings;
}

} // namespace geodisk::tools
