#include "geodisk/reports/sample_report.hpp"

#include <algorithm>
#include <sstream>

#include <geodisk/version.hpp>

#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::string mesh_text(const MeshStatistics& mesh) {
    std::string text = counted(mesh.triangles, "triangle", "triangles") + ", " +
                       counted(mesh.components, "component", "components");
    if (mesh.boundary_edges > 0) {
        text += ", " + counted(mesh.boundary_edges, "boundary edge", "boundary edges");
    }
    return text + ", area " + rounded(mesh.area, 6);
}

/// Lifts may be several, so they make a list.
Json mesh_json(const SampleJob& job, const MeshStatistics& mesh) {
    const bool has_box = mesh.diagonal > 0; // Edge lengths have none.
    Json json{{"path", job.mesh.mesh}};
    for (const auto& [name, value] : job.additions()) {
        if (name == "lift") {
            json[name].push_back(value);
        } else {
            json[name] = value;
        }
    }
    json.update({{"vertices", mesh.vertices},
                 {"triangles", mesh.triangles},
                 {"components", mesh.components},
                 {"boundary_edges", mesh.boundary_edges},
                 {"nonmanifold_edges", mesh.nonmanifold_edges},
                 {"area", mesh.area},
                 {"diagonal", has_box ? Json(mesh.diagonal) : Json(nullptr)}});
    return json;
}

/// Says what is not exact.
std::string metric_text(const SampleJob& job) {
    return job.is_geodesic() ? job.metric : job.metric + ", not exact along the surface";
}

/// Of 1, 2, ..., 9 calls of the paper's CheckStatus, and of 10 or more. Null where not counted.
Json calls_json(const SampleJob& job, const CallHistogram& calls) {
    return job.counts_calls ? Json{{"candidates", calls.candidates}, {"mean", calls.mean()}}
                            : Json(nullptr);
}

/// "1.12 of CheckStatus per disk; 1: 89.6 %, 2: 8.9 %, 3: 1.5 %", without the empty bins.
std::string calls_text(const CallHistogram& calls) {
    std::string text = rounded(calls.mean(), 3) + " of CheckStatus per disk";
    const char* separator = "; ";
    for (std::size_t bin = 0; bin < calls.candidates.size(); ++bin) {
        if (calls.candidates[bin] > 0) {
            const bool is_last = bin + 1 == calls.candidates.size();
            text += separator + std::to_string(bin + 1) + (is_last ? " or more: " : ": ") +
                    rounded(100 * calls.share(bin), 3) + " %";
            separator = ", ";
        }
    }
    return text;
}

} // namespace

SampleReport::SampleReport(const SampleJob& job, const MeshInput& mesh, const SampleResult& result)
    : job_(job), mesh_(mesh), result_(result), samples_(result.rows.size()),
      rho_(packing_density(effective_area(mesh.prepared, result.params), result.params.min_distance,
                           static_cast<double>(samples_))) {
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
    SampleHeader header{
        {{"version", "geodisk " GEODISK_VERSION_STRING},
         {"mesh", job_.mesh.mesh},
         {"min_distance", exact_text(result_.params.min_distance)},
         {"radius", exact_text(result_.params.min_distance / 2)},
         {"seed", exact_text(result_.params.seed)},
         {job_.throws_darts ? "throws" : "pool_size", exact_text(done.run.candidates)},
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
                  {"mesh", mesh_json(job_, mesh_.prepared.statistics())},
                  {"output", job_.out.output},
                  {"min_distance", params.min_distance},
                  {"radius", params.min_distance / 2},
                  {"metric", metric_text(job_)},
                  {"sample_radii", nullptr}, // Where they do not vary.
                  {"seed", params.seed},
                  {"method", job_.throws_darts ? "pdts" : "psdp"},
                  {"pool_ratio", nullptr}, // Each method has this
                  {"throws", nullptr},     // or that.
                  {"candidates", run.candidates},
                  {"chunks", run.chunks},
                  {"stopped_by", stopped_by()},
                  {"samples", samples_},
                  {"rho", rho_},
                  {"iterations", run.iterations},
                  {"dispatches", run.dispatches},
                  {"disks", run.disks},
                  {"windows", run.windows},
                  {"tested", run.tested},
                  {"most_waiting", run.most_waiting},
                  {"longest_chain", run.longest_chain},
                  {"regrown", run.regrown},
                  {"check_calls", calls_json(job_, run.calls)}};
    if (most_radius_ > 0) {
        document["sample_radii"] = {{"least", least_radius_}, {"most", most_radius_}};
    }
    if (job_.throws_darts) {
        document["throws"] = run.candidates;
    } else {
        document["pool_ratio"] = params.pool_ratio;
    }
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
    out << "              " << mesh_text(mesh_.prepared.statistics()) << '\n'
        << "min distance  " << rounded(distance, 6) << " (radius " << rounded(distance / 2, 6)
        << ") in mesh units" << (job_.is_geodesic() ? "" : ", " + metric_text(job_)) << '\n';
    if (most_radius_ > 0) {
        out << "radii         " << rounded(least_radius_, 6) << " to " << rounded(most_radius_, 6)
            << " at the samples\n";
    }
    out << "samples       " << samples_text() << ", rho " << rounded(rho_, 3) << '\n'
        << (job_.throws_darts ? "darts         " : "candidates    ")
        << grouped(result_.done.run.candidates) << ", seed " << result_.params.seed << '\n';
    if (job_.counts_calls) {
        out << "calls         " << calls_text(result_.done.run.calls) << '\n';
    }
    out << run_text(result_.done, seconds(write_seconds), job_.out.output);
    return out.str();
}

SecondsByStage SampleReport::seconds(double write_seconds) const {
    return stage_seconds({{"load", mesh_.load_seconds}, {"prepare", mesh_.prepare_seconds}},
                         result_.done, write_seconds);
}

/// What ended the run.
const char* SampleReport::stopped_by() const {
    const bool has_all = samples_ == result_.params.stop_count;
    return has_all ? "count" : job_.throws_darts ? "throws" : "pool";
}

/// "9,000", or with what was asked for where it is not that.
std::string SampleReport::samples_text() const {
    std::string text = grouped(samples_);
    if (job_.wanted_count > 0) {
        text +=
            " of about " + grouped(static_cast<std::uint64_t>(job_.wanted_count)) + " asked for";
    } else if (samples_ < result_.params.stop_count) {
        text += " of " + grouped(result_.params.stop_count) + " asked for, when the darts ran out";
    }
    return text;
}

} // namespace geodisk::tools
