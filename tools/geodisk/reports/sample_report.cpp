#include "geodisk/reports/sample_report.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include <geodisk/params.hpp>
#include <geodisk/version.hpp>

#include "files/meshes/part_columns.hpp"
#include "files/samples/fingerprint.hpp"
#include "files/samples/job_frame_text.hpp"
#include "files/samples/sample_columns.hpp"
#include "geodisk/farthest_run.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kToldElsewhere[] = {"min_distance", "seed", "darts", "stop_count",
                                               "maximal"};

/// Returns the numbers of a job that differ from their defaults, for a header. The distance, the
/// seed, and what ends a run have entries of their own.
HeaderEntries number_entries(const SampleParams& params) {
    const SampleParams plain;
    HeaderEntries defaults, entries;
    const auto write_to = [](HeaderEntries& list) {
        return [&list](const char* name, auto value) {
            if (std::ranges::find(kToldElsewhere, name) == std::end(kToldElsewhere)) {
                list.emplace_back(name, exact_text(+value)); // No bool.
            }
        };
    };
    for_each_number(plain, write_to(defaults));
    for_each_number(params, write_to(entries));
    std::erase_if(entries, [&](const auto& entry) {
        return std::ranges::find(defaults, entry) != defaults.end();
    });
    return entries;
}

/// Adds those that a report does not tell yet.
void add_numbers(Json& report, const SampleParams& params) {
    for_each_number(params, [&](const char* name, auto value) {
        if (!report.contains(name)) {
            report[name] = value;
        }
    });
}

/// Says what is not exact.
std::string metric_text(const SampleJob& job) {
    return metric_name(job.metric) + (job.is_geodesic() ? "" : ", not exact along the surface");
}

/// The distance that was given, or as it would be; `largest` is that of two samples with the
/// largest radius.
double told_distance(const SampleJob& job, const MeshInput& mesh, double largest) {
    // A part of the diagonal is that of the mesh before an edit.
    const bool is_as_given =
        job.min_distance && (job.from.empty() || !job.min_distance->is_percent);
    return is_as_given ? distance_on_mesh(*job.min_distance, mesh.prepared.statistics())
                       : largest * mesh.distance_part;
}

std::string distance_line(const SampleJob& job, const MeshInput& mesh, double largest) {
    const double least = mesh.radii ? mesh.radii->min_factor() : 1;
    const auto range = [&](double of) {
        return least < 1 ? rounded(of * least, 6) + " to " + rounded(of, 6) : rounded(of, 6);
    };
    return "min distance  " + range(largest) + " (radius " + range(largest / 2) +
           ") in mesh units" + (job.is_geodesic() ? "" : ", " + metric_text(job)) + '\n';
}

/// Returns how a maximal set was completed; null for others.
Json maximal_json(const SampleJob& job, const MeshInput& mesh, const RunReport& run) {
    if (!job.method.params.maximal) {
        return nullptr;
    }
    const MaximalReport& report = run.maximal;
    return {{"rounds", report.rounds},
            {"cells", report.cells},
            {"darts", report.darts},
            {"disks", run.disks},
            {"certificate", report.certified},
            {"largest_gap", report.largest_gap * mesh.distance_part}};
}

std::string maximal_line(const SampleJob& job, const MeshInput& mesh, const SampleResult& result) {
    if (!job.method.params.maximal) {
        return "";
    }
    const MaximalReport& report = result.done.run.maximal;
    const std::string gap = rounded(report.largest_gap * mesh.distance_part, 6);
    const std::string head = "maximal       " + counted(report.rounds, "round", "rounds") + ", ";
    if (!report.certified) {
        return head + "not certified: a gap is too small for darts\n";
    }
    if (mesh.radii) {
        return head + "certified: no further sample fits\n";
    }
    return head + "certified: every point" +
           (mesh.face_mask.empty() ? "" : " that may have a sample") + " is within " + gap +
           " of a sample" +
           (result.avoided > 0 || result.avoided_length > 0 ? " or avoided\n" : "\n");
}

/// Returns the number of samples of each class.
std::vector<std::size_t> class_counts(const SampleJob& job, const SampleResult& result) {
    std::vector<std::size_t> counts(job.classes.count);
    for (const std::uint32_t number : result.classes) {
        ++counts.at(number);
    }
    return counts;
}

/// Returns the distances of the classes in mesh units, row by row.
Json class_distances(const SampleJob& job, double largest) {
    Json rows = Json::array();
    for (std::size_t a = 0; a < job.classes.count; ++a) {
        Json& row = rows.emplace_back(Json::array());
        for (std::size_t b = 0; b < job.classes.count; ++b) {
            row.push_back(job.classes.factor(a, b) * largest);
        }
    }
    return rows;
}

/// Numbers of samples on features.
struct FeatureCounts {
    std::ptrdiff_t corners, on_curves, left_out;
    explicit FeatureCounts(const SampleResult& result)
        : corners(std::ranges::count(result.features, 2u)),
          on_curves(std::ranges::count(result.features, 1u)),
          left_out(static_cast<std::ptrdiff_t>(result.feature_corners) - corners) {}
};

std::string feature_line(const SampleResult& result) {
    const FeatureCounts counts(result);
    const auto number = [](std::ptrdiff_t n) { return static_cast<std::size_t>(n); };
    return "features      " + counted(number(counts.corners), "corner", "corners") + ", " +
           counted(number(counts.on_curves), "sample", "samples") + " on curves of length " +
           rounded(result.feature_length, 6) +
           (counts.left_out > 0 ? "; " + counted(number(counts.left_out), "corner", "corners") +
                                      " left out, closer than the distance to another"
                                : "") +
           '\n';
}

/// A level, as it is told.
struct ToldLevel {
    double min_distance;
    std::size_t samples; ///< Up to its end.
};

std::vector<ToldLevel> told_levels(const SampleResult& result, double last_distance) {
    std::vector<ToldLevel> levels;
    for (std::uint32_t level = 0; result.levels && level < result.levels->count; ++level) {
        levels.push_back({last_distance * result.levels->scale(level), result.done.ends[level]});
    }
    return levels;
}

HeaderEntries level_entries(const std::vector<ToldLevel>& levels) {
    if (levels.empty()) {
        return {};
    }
    std::string distances, samples;
    for (const ToldLevel& level : levels) {
        const char* const blank = distances.empty() ? "" : " ";
        distances += blank + exact_text(level.min_distance);
        samples += blank + std::to_string(level.samples);
    }
    return {{"order", "progressive"},
            {std::string(kLevelDistances), distances},
            {std::string(kLevelSamples), samples}};
}

std::string level_lines(const std::vector<ToldLevel>& levels) {
    std::string text;
    for (const ToldLevel& level : levels) {
        text += (text.empty() ? "levels        " : "              ") + grouped(level.samples) +
                " samples at distance " + rounded(level.min_distance, 6) + '\n';
    }
    return text;
}

Json levels_json(const std::vector<ToldLevel>& levels) {
    if (levels.empty()) {
        return nullptr;
    }
    Json list = Json::array();
    for (const ToldLevel& level : levels) {
        list.push_back({{"min_distance", level.min_distance}, {"samples", level.samples}});
    }
    return list;
}

/// Says how many samples were given and points avoided, and those of each class, if any were.
std::string constraint_lines(const SampleJob& job, const SampleResult& result) {
    std::string text;
    if (job.classes.is_given()) {
        for (const std::size_t count : class_counts(job, result)) {
            text += (text.empty() ? "classes       " : ", ") + grouped(count);
        }
        text += " samples\n";
    }
    if (result.existing > 0) {
        const SpacingResult& pairs = result.among_existing;
        text += "existing      " + grouped(result.existing) + " of them";
        text +=
            pairs.violations.empty() ? "" : "; " + pairs.pairs_text() + " among these too close";
        text += '\n';
    }
    if (job.features) {
        text += feature_line(result);
    }
    const std::string avoided = avoided_text(result.avoided, result.avoided_length);
    return text + (avoided.empty() ? "" : "avoided       " + avoided + '\n');
}

} // namespace

std::string dry_sample_json(const SampleJob& job, const MeshInput& mesh, const DryRun& dry) {
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(mesh)},
                  {"warnings", warnings_json(mesh.warnings)},
                  {"metric", metric_text(job)}};
    document.update(dry_run_json(dry));
    document["min_distance"] = told_distance(job, mesh, dry.min_distance);
    return text_of(document);
}

std::string dry_sample_text(const SampleJob& job, const MeshInput& mesh, const DryRun& dry) {
    return mesh_lines("mesh", mesh) + distance_line(job, mesh, dry.min_distance) +
           dry_run_text(dry);
}

std::string SampleResult::digest() const {
    return all ? digest_text(all->digest) : digest_of(rows);
}

SampleReport::SampleReport(const SampleJob& job, const MeshInput& mesh, const SampleResult& result)
    : job_(job), mesh_(mesh), result_(result),
      samples_(result.farthest ? result.farthest->samples : result.count()),
      rho_(packing_density(mesh.effective_area(result.params), result.params.min_distance,
                           static_cast<double>(samples_))),
      radii_(result.all ? result.all->radii : RadiusRange(result.rows)) {}

bool SampleReport::is_told(const JobFrame& frame, double distance) const {
    SampleParams params = result_.params;
    params.min_distance = distance / mesh_.distance_part;
    const auto plain = frame_of(mesh_.sampled(), params);
    return plain && decide_alike(frame, *plain);
}

SampleHeader SampleReport::header() const {
    const DeviceRun& done = result_.done;
    const HeaderEntries& additions = mesh_.additions;
    const double distance = told_distance(job_, mesh_, result_.params.min_distance);
    SampleHeader header{{{"version", "geodisk " GEODISK_VERSION_STRING},
                         {std::string(kSamplingVersion), std::to_string(GEODISK_SAMPLING_VERSION)},
                         {"mesh", job_.mesh.mesh},
                         {"min_distance", exact_text(distance)},
                         {"radius", exact_text(distance / 2)},
                         {"seed", exact_text(result_.params.seed)},
                         candidates_entry(drawn()),
                         {std::string(kDigest), result_.digest()},
                         {"device", done.device.name},
                         {"driver", driver_text(done.device)}}};
    header.entries.insert(header.entries.begin() + 3, additions.begin(), additions.end());
    if (std::string digest = surface_digest_text(mesh_); !digest.empty()) {
        header.entries.emplace_back(kSurfaceDigest, std::move(digest));
    }
    for (const auto& [key, path] : {std::pair{"from", job_.from}, {"update", job_.update}}) {
        if (!path.empty()) {
            header.entries.emplace_back(key, path);
        }
    }
    for (auto& entry : number_entries(job_.params)) {
        header.entries.push_back(std::move(entry));
    }
    if (result_.frame && !is_told(*result_.frame, distance)) {
        header.entries.emplace_back(kJobFrame, job_frame_text(*result_.frame));
    }
    if (done.cut > 0 && job_.method.class_counts.empty()) {
        header.entries.emplace_back("exact", std::to_string(result_.count()));
    }
    if (!job_.is_geodesic()) {
        header.entries.emplace_back("metric", metric_text(job_));
    }
    if (job_.features) {
        header.entries.emplace_back("features", exact_text(*job_.features));
    }
    if (job_.at_vertices) {
        header.entries.emplace_back("at_vertices", "yes");
    }
    if (job_.classes.is_given()) {
        header.entries.emplace_back("classes", job_.classes.text(distance));
    }
    if (job_.method.params.maximal) {
        header.entries.emplace_back("maximal",
                                    done.run.maximal.certified ? "certified" : "not certified");
    }
    for (const HeaderEntries& more :
         {job_.out.record.entries(), frame_entries(frame_style(job_.out, job_.mesh)),
          job_.constraints.entries(), level_entries(told_levels(result_, distance)),
          part_name_entries(mesh_.file, job_.columns)}) {
        header.entries.insert(header.entries.end(), more.begin(), more.end());
    }
    if (result_.farthest) {
        const HeaderEntries more = farthest_entries(*result_.farthest);
        header.entries.insert(header.entries.end(), more.begin(), more.end());
    }
    return header;
}

std::string SampleReport::json(double write_seconds) const {
    return text_of(document({{"write", write_seconds}}));
}

std::string SampleReport::summary(double write_seconds) const {
    return summary(SecondsByStage{{"write", write_seconds}});
}

Json SampleReport::document(const SecondsByStage& after) const {
    const RunReport& run = result_.done.run;
    const SampleParams& params = result_.params;
    std::vector<MeshWarning> warnings = mesh_.warnings;
    warnings.insert(warnings.end(), result_.warnings.begin(), result_.warnings.end());
    const double distance = told_distance(job_, mesh_, params.min_distance);
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"sampling_version", GEODISK_SAMPLING_VERSION},
                  {"mesh", mesh_json(mesh_)},
                  {"warnings", warnings_json(warnings)},
                  {"output", job_.out.output},
                  {"min_distance", distance},
                  {"radius", distance / 2},
                  {"metric", metric_text(job_)},
                  {"sample_radii", nullptr}, // Where they do not vary.
                  {"existing", nullptr},
                  {"avoided", result_.avoided}, // Without --existing.
                  {"avoided_length", result_.avoided_length},
                  {"classes", nullptr},
                  {"features", nullptr},
                  {"levels", levels_json(told_levels(result_, distance))},
                  {"farthest", nullptr},
                  {"seed", params.seed}};
    document["mesh"]["components_without_samples"] = result_.bare.count;
    if (result_.picture) {
        document["picture"] = job_.picture;
    }
    document["scene"] = scene_json(result_.scene);
    if (radii_.do_vary()) {
        document["sample_radii"] = {{"least", radii_.least}, {"most", radii_.most}};
    }
    if (result_.existing > 0) {
        document["existing"] = {{"samples", result_.existing},
                                {"close_pairs", result_.among_existing.violations.size()},
                                {"complete", result_.among_existing.is_complete},
                                {"closest", pair_json(result_.among_existing.closest)}};
    }
    if (job_.features) {
        const FeatureCounts counts(result_);
        document["features"] = {{"corners", counts.corners},
                                {"on_curves", counts.on_curves},
                                {"corners_left_out", counts.left_out},
                                {"length", result_.feature_length}};
    }
    if (job_.classes.is_given()) {
        document["classes"] = {{"distances", class_distances(job_, distance)},
                               {"samples", class_counts(job_, result_)}};
    }
    document.update(drawn_json(drawn()));
    if (result_.farthest) {
        document["farthest"] = farthest_json(*result_.farthest);
        document["samples"] = result_.rows.size();
    }
    document["maximal"] = maximal_json(job_, mesh_, run);
    document.update({{"rho", rho_},
                     {"batches", run.batches},
                     {"dispatches", run.dispatches},
                     {"disks", run.disks},
                     {"windows", run.windows},
                     {"tested", run.tested},
                     {"max_waiting", run.max_waiting},
                     {"longest_chain", run.longest_chain},
                     {"regrown", run.regrown},
                     {"starts", run.starts}});
    document.update(run_json(result_.done, seconds(after)));
    add_numbers(document, params);
    return document;
}

std::string SampleReport::summary(const SecondsByStage& after) const {
    std::ostringstream out;
    out << mesh_lines("mesh", mesh_, result_.bare.count)
        << distance_line(job_, mesh_, result_.params.min_distance);
    if (radii_.do_vary()) {
        out << "radii         " << rounded(radii_.least, 6) << " to " << rounded(radii_.most, 6)
            << " at the samples\n";
    }
    out << "samples       " << samples_text(drawn()) << ", rho " << rounded(rho_, 3) << '\n'
        << level_lines(
               told_levels(result_, told_distance(job_, mesh_, result_.params.min_distance)))
        << maximal_line(job_, mesh_, result_) << constraint_lines(job_, result_)
        << candidates_text(drawn(), result_.params.seed);
    if (result_.farthest) {
        out << farthest_line(*result_.farthest);
    }
    out << run_text(result_.done, seconds(after), job_.out.output)
        << frame_line(frame_style(job_.out, job_.mesh)) << scene_line(result_.scene);
    if (result_.picture) {
        out << "picture       " << one_line(job_.picture) << '\n';
    }
    return out.str();
}

SecondsByStage SampleReport::seconds(const SecondsByStage& after) const {
    SecondsByStage stages = after;
    if (const auto& picture = result_.picture) {
        stages.insert(stages.begin(),
                      {{"windows", picture->window_seconds}, {"draw", picture->draw_seconds}});
    }
    if (result_.farthest) {
        stages.insert(stages.begin(), {"order", result_.farthest->seconds});
    }
    return stage_seconds({{"load", mesh_.load_seconds}, {"prepare", mesh_.prepare_seconds}},
                         result_.done, stages);
}

Drawn SampleReport::drawn() const {
    return {job_.method, result_.done, job_.wanted_count, samples_};
}

} // namespace geodisk::tools
