#include "geodisk/reports/page_report.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "geodisk/commit.hpp"
#include "geodisk/reports/json.hpp"
#include "picture/legend.hpp"
#include "picture/scene.hpp"
#include "picture/window_table.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "report/sample_data.hpp"
#include "report/surface_data.hpp"

namespace geodisk::tools {
namespace {

/// Maximum that a browser opens within seconds, as pages of about 200 MB.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 22;
/// The same of windows, as 64 MB.
constexpr std::size_t kMaxWindows = std::size_t{1} << 22;
constexpr double kSteepest = 89.9; // Degrees.

void append(std::vector<report::PageArray>& to, std::vector<report::PageArray> arrays) {
    to.insert(to.end(), std::make_move_iterator(arrays.begin()),
              std::make_move_iterator(arrays.end()));
}

void add_disks(const MeshInput& mesh, std::span<const SurfaceDisk> disks, ProgressLine& progress,
               PageContent& content) {
    progress.begin_stage("computing the disks");
    const auto tell = [&](double part) {
        check_interrupted();
        progress.update(part, grouped(disks.size()) + " disks");
    };
    auto table = picture::try_window_table(mesh.prepared, disks, 2 * median_radius(disks), tell,
                                           kMaxWindows);
    if (!table) {
        content.left_out.push_back("The disks, as they light more than " + grouped(kMaxWindows) +
                                   " places of the surface, too many for a page. Samples are "
                                   "shown as points.");
        return;
    }
    report::DiskData data = report::disk_data(*table);
    append(content.arrays, std::move(data.arrays));
    content.disks = data.scale;
    content.windows = table->windows.size();
}

Json vector_json(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

/// Returns what the page needs to know to show its arrays.
Json view_json(const PageResult& result) {
    const PageContent& content = result.content;
    Json from = Json::array();
    for (picture::View view : result.views) {
        // From right above there would be no telling what is up.
        view.elevation = std::clamp(view.elevation, -kSteepest, kSteepest);
        from.push_back(vector_json(picture::direction_of(view, content.up)));
    }
    Json json{{"surface", content.has_surface},
              {"disks", nullptr}, // Where they are left out.
              {"left_out", content.left_out},
              {"windows", content.windows},
              {"up", vector_json(picture::direction_of(content.up))},
              {"from", from},
              {"light", vector_json(picture::kLight)},
              {"class_colors", Json::array()}};
    for (std::size_t number = 0; number < result.set.classes.size(); ++number) {
        json["class_colors"].push_back(vector_json(picture::class_color(number)));
    }
    if (const auto& disks = content.disks) {
        json["disks"] = {{"unit", disks->unit},
                         {"cells_per_unit", disks->cells_per_unit},
                         {"seam", disks->seam}};
    }
    return json;
}

/// Ring by ring.
Json spectrum_json(const SpectrumRun& run, double min_distance) {
    Json frequency = Json::array(), power = Json::array(), anisotropy = Json::array();
    for (const analysis::SpectrumRing& ring : run.spectrum.rings()) {
        frequency.push_back(ring.frequency * min_distance);
        power.push_back(ring.mean);
        anisotropy.push_back(analysis::decibels(ring.anisotropy));
    }
    // Expected power of one set, whose waves are real ones.
    constexpr double kExpected = 2;
    return {{"unit", "waves per minimum distance"},
            {"harmonics", run.spectrum.frequencies.size()},
            {"seconds", run.seconds},
            {"expected", analysis::decibels(kExpected)},
            {"caption", "By " + grouped(run.spectrum.frequencies.size()) +
                            " waves of the surface. Independent points have power 1; blue noise "
                            "has little up to half a wave per minimum distance."},
            {"frequency", std::move(frequency)},
            {"power", std::move(power)},
            {"anisotropy", std::move(anisotropy)}};
}

} // namespace

PageContent make_page_content(const MeshInput& mesh, const SampleDisks& samples,
                              std::span<const analysis::Neighbor> neighbors,
                              std::optional<picture::Up> up, ProgressLine& progress) {
    PageContent content;
    content.arrays = report::sample_arrays(samples, neighbors);
    if (mesh.dimension() == 0) {
        content.left_out.emplace_back("The surface, as the mesh has edge lengths without "
                                      "coordinates, so that there is nothing to look at.");
        return content;
    }
    if (mesh.file.triangle_count() > kMaxTriangles) {
        content.left_out.push_back("The surface, as it has more than " + grouped(kMaxTriangles) +
                                   " triangles, too many for a page.");
        return content;
    }
    add_disks(mesh, samples.disks, progress, content);
    progress.begin_stage("preparing the page");
    const picture::Scene scene =
        picture::make_scene(mesh.file.positions, mesh.dimension(), mesh.file.triangles);
    append(content.arrays, report::surface_arrays(scene, mesh.file.triangles));
    content.has_surface = true;
    content.up = up.value_or(picture::likely_up(scene));
    progress.clear();
    return content;
}

std::string PageReport::facts() const {
    Json facts = document(stages());
    facts["seed"] = facts["seed"].dump(); // JavaScript would round a number of 64 bits.
    return text_of(facts);
}

std::string PageReport::json(double write_seconds) const {
    return text_of(document(stages(write_seconds)));
}

std::string PageReport::summary(double write_seconds) const {
    const analysis::SurfaceStatistics& found = result_.set.found;
    std::ostringstream out;
    out << samples_.summary(stages(write_seconds));
    if (found.lonely < result_.set.samples) {
        out << "nearest       " << fixed(found.smallest, 5) << " at least, "
            << fixed(found.mean_nearest, 3) << " on average, in minimum distances"
            << (result_.set.classes.empty() ? "\n" : " of classes\n");
    }
    out << "room for more " << fixed(100 * found.uncovered, 2) << " % of the area\n";
    for (const std::string& sentence : result_.content.left_out) {
        out << "left out      " << sentence << '\n';
    }
    return out.str();
}

SecondsByStage PageReport::stages() const {
    SecondsByStage stages{{"measure", result_.measure_seconds}};
    if (result_.spectrum) {
        stages.emplace_back("spectrum", result_.spectrum->seconds);
    }
    stages.emplace_back("disks", result_.disk_seconds);
    double told = 0;
    for (const auto& [stage, seconds] : samples_.seconds(stages)) {
        told += seconds;
    }
    stages.emplace_back("other", std::max(0.0, result_.all_seconds - told));
    return stages;
}

SecondsByStage PageReport::stages(double write_seconds) const {
    SecondsByStage all = stages();
    all.emplace_back("write", write_seconds);
    return all;
}

Json PageReport::document(const SecondsByStage& after) const {
    Json document = samples_.document(after);
    document["commit"] = kCommit;
    document["commit_is_dirty"] = kCommitIsDirty;
    document["command"] = result_.command;
    document["analysis"] = set_json(result_.set);
    document["analysis"].erase("samples_file"); // There is none.
    document["spectrum"] = result_.spectrum
                               ? spectrum_json(*result_.spectrum, result_.set.min_distance)
                               : Json(nullptr);
    document["view"] = view_json(result_);
    return document;
}

} // namespace geodisk::tools
