#include "geodisk/sample_report.hpp"

#include <algorithm>
#include <utility>

#include <geodisk/version.hpp>

#include "common/number_text.hpp"
#include "geodisk/json_text.hpp"
#include "geodisk/report_parts.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

Json seconds_json(const SampleReport& report) {
    return {{"load", report.seconds.load},
            {"prepare", report.seconds.prepare},
            {"device", report.seconds.device},
            {"pipelines", report.seconds.pipelines},
            {"upload", report.run.seconds.upload},
            {"sample", report.run.seconds.sample},
            {"readback", report.run.seconds.readback},
            {"write", report.seconds.write}};
}

double total_seconds(const SampleReport& report) {
    double total = 0;
    for (const auto& stage : seconds_json(report)) {
        total += stage.get<double>();
    }
    return total;
}

std::string mesh_text(const MeshStatistics& mesh) {
    std::string text = counted(mesh.triangles, "triangle", "triangles") + ", " +
                       counted(mesh.components, "component", "components");
    if (mesh.boundary_edges > 0) {
        text += ", " + counted(mesh.boundary_edges, "boundary edge", "boundary edges");
    }
    return text + ", area " + rounded(mesh.area, 6);
}

/// Lifts may be several, so they make a list.
Json mesh_json(const SampleReport& report) {
    const bool has_box = report.mesh.diagonal > 0; // Edge lengths have none.
    Json mesh{{"path", report.mesh_path}};
    for (const auto& [name, value] : report.mesh_additions) {
        if (name == "lift") {
            mesh[name].push_back(value);
        } else {
            mesh[name] = value;
        }
    }
    mesh.update({{"vertices", report.mesh.vertices},
                 {"triangles", report.mesh.triangles},
                 {"components", report.mesh.components},
                 {"boundary_edges", report.mesh.boundary_edges},
                 {"nonmanifold_edges", report.mesh.nonmanifold_edges},
                 {"area", report.mesh.area},
                 {"diagonal", has_box ? Json(report.mesh.diagonal) : Json(nullptr)}});
    return mesh;
}

/// Says what is not exact.
std::string metric_text(const std::string& metric) {
    return metric == "geodesic" ? metric : metric + ", not exact along the surface";
}

/// Null where radii do not vary.
Json radii_json(const SampleReport& report) {
    return report.most_radius > 0
               ? Json{{"least", report.least_radius}, {"most", report.most_radius}}
               : Json(nullptr);
}

/// What ended the run.
const char* stopped_by(const SampleReport& report) {
    const bool has_all = report.samples == report.params.stop_count;
    return has_all ? "count" : report.throws_darts ? "throws" : "pool";
}

/// "9,000", or with what was asked for where it is not that.
std::string samples_text(const SampleReport& report) {
    std::string text = grouped(report.samples);
    if (report.wanted_count > 0) {
        text +=
            " of about " + grouped(static_cast<std::uint64_t>(report.wanted_count)) + " asked for";
    } else if (report.samples < report.params.stop_count) {
        text += " of " + grouped(report.params.stop_count) + " asked for, when the darts ran out";
    }
    return text;
}

/// Of 1, 2, ..., 9 calls of the paper's CheckStatus, and of 10 or more. Null where not counted.
Json calls_json(const SampleReport& report) {
    const CallHistogram& calls = report.run.calls;
    return report.counts_calls ? Json{{"candidates", calls.candidates}, {"mean", calls.mean()}}
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

void SampleReport::set_radii(std::span<const SampleRow> rows) {
    if (has_radii(rows)) {
        const auto [least, most] = std::minmax_element(
            rows.begin(), rows.end(),
            [](const SampleRow& a, const SampleRow& b) { return a.radius < b.radius; });
        least_radius = least->radius;
        most_radius = most->radius;
    }
}

SampleHeader sample_header(const SampleReport& report) {
    const char* const drawn = report.throws_darts ? "throws" : "pool_size";
    SampleHeader header{{{"version", "geodisk " GEODISK_VERSION_STRING},
                         {"mesh", report.mesh_path},
                         {"min_distance", exact_text(report.params.min_distance)},
                         {"radius", exact_text(report.params.min_distance / 2)},
                         {"seed", exact_text(report.params.seed)},
                         {drawn, exact_text(report.run.candidates)},
                         {"device", report.device.name},
                         {"driver", driver_text(report.device)}}};
    header.entries.insert(header.entries.begin() + 2, report.mesh_additions.begin(),
                          report.mesh_additions.end());
    if (report.metric != "geodesic") {
        header.entries.emplace_back("metric", metric_text(report.metric));
    }
    return header;
}

std::string json_text(const SampleReport& report) {
    const RunReport& run = report.run;
    // Each method has one of these.
    const Json throws = report.throws_darts ? Json(run.candidates) : Json(nullptr);
    const Json pool_ratio = report.throws_darts ? Json(nullptr) : Json(report.params.pool_ratio);
    const Json document{{"version", GEODISK_VERSION_STRING},
                        {"mesh", mesh_json(report)},
                        {"output", report.output_path},
                        {"min_distance", report.params.min_distance},
                        {"radius", report.params.min_distance / 2},
                        {"metric", metric_text(report.metric)},
                        {"sample_radii", radii_json(report)},
                        {"seed", report.params.seed},
                        {"method", report.throws_darts ? "pdts" : "psdp"},
                        {"pool_ratio", pool_ratio},
                        {"throws", throws},
                        {"candidates", run.candidates},
                        {"chunks", run.chunks},
                        {"stopped_by", stopped_by(report)},
                        {"samples", report.samples},
                        {"rho", report.rho},
                        {"iterations", run.iterations},
                        {"dispatches", run.dispatches},
                        {"disks", run.disks},
                        {"windows", run.windows},
                        {"tested", run.tested},
                        {"most_waiting", run.most_waiting},
                        {"longest_chain", run.longest_chain},
                        {"regrown", run.regrown},
                        {"check_calls", calls_json(report)},
                        {"guard", run.guard},
                        {"device_bytes", run.device_bytes},
                        {"seconds", seconds_json(report)},
                        {"tuning", tuning_json(report.tuning)},
                        {"device", device_json(report.device)}};
    return text_of(document);
}

void print_summary(std::ostream& out, const SampleReport& report) {
    const double distance = report.params.min_distance;
    out << "mesh          " << one_line(report.mesh_path) << '\n';
    for (const auto& [name, value] : report.mesh_additions) {
        out << "              " << name << ' ' << one_line(value) << '\n';
    }
    out << "              " << mesh_text(report.mesh) << '\n'
        << "min distance  " << rounded(distance, 6) << " (radius " << rounded(distance / 2, 6)
        << ") in mesh units"
        << (report.metric == "geodesic" ? "" : ", " + metric_text(report.metric)) << '\n';
    if (report.most_radius > 0) {
        out << "radii         " << rounded(report.least_radius, 6) << " to "
            << rounded(report.most_radius, 6) << " at the samples\n";
    }
    out << "samples       " << samples_text(report) << ", rho " << rounded(report.rho, 3) << '\n'
        << (report.throws_darts ? "darts         " : "candidates    ")
        << grouped(report.run.candidates) << ", seed " << report.params.seed << '\n';
    if (report.counts_calls) {
        out << "calls         " << calls_text(report.run.calls) << '\n';
    }
    out << "time          " << seconds_text(report.run.seconds.sample) << " sampling, "
        << seconds_text(total_seconds(report)) << " in all\n"
        << "device        " << one_line(report.device.name) << '\n'
        << "file          " << one_line(report.output_path) << '\n';
}

} // namespace geodisk::tools
