#include "geodisk/reports/sample_report.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include <geodisk/version.hpp>

#include "geodisk/reports/mesh_parts.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::string mesh_text(const MeshInput& input, std::uint64_t bare_components) {
    const MeshStatistics& mesh = input.prepared.statistics();
    std::string text = counted(mesh.triangles, "triangle", "triangles") + ", " +
                       counted(mesh.components, "component", "components");
    if (bare_components > 0) {
        text += " (" + grouped(bare_components) + " without a sample)";
    }
    if (mesh.boundary_edges > 0) {
        text += ", " + counted(mesh.boundary_edges, "boundary edge", "boundary edges");
    }
    if (mesh.coinciding_border_edges > 0) {
        text += ", " + grouped(mesh.coinciding_border_edges) + " of them in one place with others";
    }
    if (const auto& weld = input.file.weld) {
        text += ", " + counted(weld->merged_vertices, "vertex", "vertices") + " joined to others";
        if (weld->degenerate_faces > 0) {
            text += " and " + counted(weld->degenerate_faces, "triangle", "triangles") +
                    " dropped by it";
        }
    }
    return text + ", area " + rounded(mesh.area, 6);
}

/// Lifts may be several, so they make a list.
Json mesh_json(const SampleJob& job, const MeshInput& input, std::uint64_t bare_components) {
    const MeshStatistics& mesh = input.prepared.statistics();
    const std::optional<WeldCounts>& weld = input.file.weld;
    const bool has_box = mesh.diagonal > 0; // Edge lengths have none.
    Json json{{"path", job.mesh.mesh}};
    for (const auto& [name, value] : job.additions()) {
        if (name == "lift") {
            json[name].push_back(value);
        } else {
            json[name] = value;
        }
    }
    json.update(
        {{"vertices", mesh.vertices},
         {"triangles", mesh.triangles},
         {"polygons", input.file.polygons.empty() ? Json(nullptr) : Json(input.file.polygon_count)},
         {"merged_vertices", weld ? Json(weld->merged_vertices) : Json(nullptr)},
         {"welded_triangles", weld ? Json(weld->degenerate_faces) : Json(nullptr)},
         {"dropped_triangles", mesh.repeated_index_faces},
         {"components", mesh.components},
         {"components_without_samples", bare_components},
         {"boundary_edges", mesh.boundary_edges},
         {"coinciding_border_edges", mesh.coinciding_border_edges},
         {"nonmanifold_edges", mesh.nonmanifold_edges},
         {"area", mesh.area},
         {"diagonal", has_box ? Json(mesh.diagonal) : Json(nullptr)}});
    return json;
}

/// Says what is not exact.
std::string metric_text(const SampleJob& job) {
    return job.is_geodesic() ? job.metric : job.metric + ", not exact along the surface";
}

} // namespace

SampleReport::SampleReport(const SampleJob& job, const MeshInput& mesh, const SampleResult& result)
    : job_(job), mesh_(mesh), result_(result), samples_(result.rows.size()),
      rho_(packing_density(effective_area(mesh.prepared, result.params), result.params.min_distance,
                           static_cast<double>(samples_))) {
    if (mesh.prepared.statistics().components > 1) {
        std::vector<std::uint32_t> faces;
        for (const SampleRow& row : result.rows) {
            faces.push_back(row.face);
        }
        bare_components_ = parts_without(mesh.file.triangles, faces);
    }
    if (has_radii(result.rows)) {
        const auto [least, most] = std::ranges::minmax_element(
            result.rows, {}, [](const auto& row) { return row.radius; });
        least_radius_ = least->radius;
        most_radius_ = most->radius;
    }
}

SampleHeader SampleReport::header() const {
    const DeviceRun& done = result_.done;
    const HeaderEntries additions = job_.additions();
    SampleHeader header{{{"version", "geodisk " GEODISK_VERSION_STRING},
                         {"mesh", job_.mesh.mesh},
                         {"min_distance", exact_text(result_.params.min_distance)},
                         {"radius", exact_text(result_.params.min_distance / 2)},
                         {"seed", exact_text(result_.params.seed)},
                         candidates_entry(drawn()),
                         {"device", done.device.name},
                         {"driver", driver_text(done.device)}}};
    header.entries.insert(header.entries.begin() + 2, additions.begin(), additions.end());
    if (!job_.is_geodesic()) {
        header.entries.emplace_back("metric", metric_text(job_));
    }
    return header;
}

std::string SampleReport::json(double write_seconds) const {
    const RunReport& run = result_.done.run;
    const SampleParams& params = result_.params;
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(job_, mesh_, bare_components_)},
                  {"warnings", warnings_json(mesh_.warnings)},
                  {"output", job_.out.output},
                  {"min_distance", params.min_distance},
                  {"radius", params.min_distance / 2},
                  {"metric", metric_text(job_)},
                  {"sample_radii", nullptr}, // Where they do not vary.
                  {"seed", params.seed}};
    if (most_radius_ > 0) {
        document["sample_radii"] = {{"least", least_radius_}, {"most", most_radius_}};
    }
    document.update(drawn_json(drawn()));
    document.update({{"rho", rho_},
                     {"iterations", run.iterations},
                     {"dispatches", run.dispatches},
                     {"disks", run.disks},
                     {"windows", run.windows},
                     {"tested", run.tested},
                     {"most_waiting", run.most_waiting},
                     {"longest_chain", run.longest_chain},
                     {"regrown", run.regrown},
                     {"check_calls", calls_json(drawn())}});
    document.update(run_json(result_.done, seconds(write_seconds)));
    return text_of(document);
}

std::string SampleReport::summary(double write_seconds) const {
    const double distance = result_.params.min_distance;
    std::ostringstream out;
    out << "mesh          " << one_line(job_.mesh.mesh) << '\n';
    for (const auto& [name, value] : job_.additions()) {
        out << "              " << name << ' ' << one_line(value) << '\n';
    }
    out << "              " << mesh_text(mesh_, bare_components_) << '\n'
        << "min distance  " << rounded(distance, 6) << " (radius " << rounded(distance / 2, 6)
        << ") in mesh units" << (job_.is_geodesic() ? "" : ", " + metric_text(job_)) << '\n';
    if (most_radius_ > 0) {
        out << "radii         " << rounded(least_radius_, 6) << " to " << rounded(most_radius_, 6)
            << " at the samples\n";
    }
    out << "samples       " << samples_text(drawn()) << ", rho " << rounded(rho_, 3) << '\n'
        << candidates_text(drawn(), result_.params.seed);
    out << run_text(result_.done, seconds(write_seconds), job_.out.output);
    return out.str();
}

SecondsByStage SampleReport::seconds(double write_seconds) const {
    return stage_seconds({{"load", mesh_.load_seconds}, {"prepare", mesh_.prepare_seconds}},
                         result_.done, write_seconds);
}

Drawn SampleReport::drawn() const {
    return {job_.method, result_.done.run, job_.wanted_count, samples_, result_.done.runs};
}

} // namespace geodisk::tools
