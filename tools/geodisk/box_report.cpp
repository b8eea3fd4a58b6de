#include "geodisk/box_report.hpp"

#include <cmath>

#include <geodisk/version.hpp>

#include "common/number_text.hpp"
#include "geodisk/box_text.hpp"
#include "geodisk/report_parts.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

Json seconds_json(const BoxReport& report) {
    return {{"device", report.seconds.device},         {"pipelines", report.seconds.pipelines},
            {"upload", report.run.seconds.upload},     {"sample", report.run.seconds.sample},
            {"readback", report.run.seconds.readback}, {"write", report.seconds.write}};
}

double total_seconds(const BoxReport& report) {
    double total = 0;
    for (const auto& stage : seconds_json(report)) {
        total += stage.get<double>();
    }
    return total;
}

} // namespace

double BoxReport::density() const {
    // Volume of the unit ball: pi^(n/2) / Gamma(n/2 + 1).
    constexpr double kPi = 3.14159265358979323846;
    const auto n = static_cast<double>(box.extents.size());
    double density = static_cast<double>(samples) * std::pow(kPi, n / 2) / std::tgamma(n / 2 + 1);
    for (const double side : box.extents) {
        density *= box.min_distance / 2 / side;
    }
    return density;
}

SampleHeader sample_header(const BoxReport& report) {
    return {{{"version", "geodisk " GEODISK_VERSION_STRING},
             {"box", sides_text(report.box, exact_text<double>)},
             {"sides", kind_text(report.box)},
             {"min_distance", exact_text(report.box.min_distance)},
             {"seed", exact_text(report.box.seed)},
             {"pool_size", exact_text(report.run.candidates)},
             {"device", report.device.name},
             {"driver", driver_text(report.device)}}};
}

std::string json_text(const BoxReport& report) {
    const RunReport& run = report.run;
    return text_of({{"version", GEODISK_VERSION_STRING},
                    {"box",
                     {{"dimension", report.box.extents.size()},
                      {"extents", report.box.extents},
                      {"periodic", report.box.is_periodic}}},
                    {"output", report.output_path},
                    {"min_distance", report.box.min_distance},
                    {"seed", report.box.seed},
                    {"pool_ratio", report.box.pool_ratio},
                    {"candidates", run.candidates},
                    {"chunks", run.chunks},
                    {"samples", report.samples},
                    {"density", report.density()},
                    {"iterations", run.iterations},
                    {"dispatches", run.dispatches},
                    {"disks", run.disks},
                    {"rows", run.windows},
                    {"tested", run.tested},
                    {"most_conflicts", run.most_conflicts},
                    {"regrown", run.regrown},
                    {"guard", run.guard},
                    {"device_bytes", run.device_bytes},
                    {"seconds", seconds_json(report)},
                    {"tuning", tuning_json(report.tuning)},
                    {"device", device_json(report.device)}});
}

void print_summary(std::ostream& out, const BoxReport& report) {
    out << "box           " << box_text(report.box) << '\n'
        << "min distance  " << rounded(report.box.min_distance, 6) << '\n'
        << "samples       " << grouped(report.samples);
    if (report.wanted_count > 0) {
        out << " of about " << grouped(static_cast<std::uint64_t>(report.wanted_count))
            << " asked for";
    }
    out << ", disks fill " << rounded(100 * report.density(), 3) << " %\n"
        << "candidates    " << grouped(report.run.candidates) << ", seed " << report.box.seed
        << '\n'
        << "time          " << seconds_text(report.run.seconds.sample) << " sampling, "
        << seconds_text(total_seconds(report)) << " in all\n"
        << "device        " << one_line(report.device.name) << '\n'
        << "file          " << one_line(report.output_path) << '\n';
}

} // namespace geodisk::tools
