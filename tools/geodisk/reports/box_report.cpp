#include "geodisk/reports/box_report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <geodisk/version.hpp>

#include "files/samples/sample_columns.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// "1 x 0.5 x 2".
std::string sides_text(const BoxParams& box, std::string (*text)(double side)) {
    std::string sides;
    for (const double side : box.extents) {
        sides += (sides.empty() ? "" : " x ") + text(side);
    }
    return sides;
}

/// "open" or "periodic".
const char* kind_text(const BoxParams& box) {
    return box.is_periodic ? "periodic" : "open";
}

Json box_json(const BoxParams& box) {
    return {
        {"dimension", box.extents.size()}, {"extents", box.extents}, {"periodic", box.is_periodic}};
}

} // namespace

std::string box_text(const BoxParams& box) {
    return sides_text(box, [](double side) { return rounded(side, 6); }) + ", " + kind_text(box);
}

std::string dry_box_json(const BoxJob& job, const DryRun& dry) {
    Json document{{"version", GEODISK_VERSION_STRING}, {"box", box_json(job.box)}};
    document.update(dry_run_json(dry));
    return text_of(document);
}

std::string dry_box_text(const BoxJob& job, const DryRun& dry) {
    return "box           " + box_text(job.box) + "\nmin distance  " +
           rounded(dry.min_distance, 6) + '\n' + dry_run_text(dry);
}

BoxReport::BoxReport(const BoxJob& job, std::size_t samples, const DeviceRun& done)
    : job_(job), done_(done), samples_(samples) {
    // Volume of the unit ball: pi^(n/2) / Gamma(n/2 + 1).
    const auto n = static_cast<double>(job.box.extents.size());
    density_ =
        static_cast<double>(samples_) * std::pow(std::numbers::pi, n / 2) / std::tgamma(n / 2 + 1);
    for (const double side : job.box.extents) {
        density_ *= job.box.min_distance / 2 / side;
    }
}

Drawn BoxReport::drawn() const {
    return {job_.method, done_, job_.wanted_count, samples_};
}

SampleHeader BoxReport::header() const {
    return {{{"version", "geodisk " GEODISK_VERSION_STRING},
             {std::string(kSamplingVersion), std::to_string(GEODISK_SAMPLING_VERSION)},
             {"box", sides_text(job_.box, exact_text<double>)},
             {"sides", kind_text(job_.box)},
             {"min_distance", exact_text(job_.box.min_distance)},
             {"seed", exact_text(job_.box.seed)},
             candidates_entry(drawn()),
             {"device", done_.device.name},
             {"driver", driver_text(done_.device)}}};
}

std::string BoxReport::json(double write_seconds) const {
    const RunReport& run = done_.run;
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"sampling_version", GEODISK_SAMPLING_VERSION},
                  {"box", box_json(job_.box)},
                  {"output", job_.out.output},
                  {"min_distance", job_.box.min_distance},
                  {"seed", job_.box.seed}};
    document.update(drawn_json(drawn()));
    document.update({{"density", density_},
                     {"batches", run.batches},
                     {"dispatches", run.dispatches},
                     {"disks", run.disks},
                     {"rows", run.windows},
                     {"tested", run.tested},
                     {"max_conflicts", run.max_conflicts},
                     {"regrown", run.regrown},
                     {"starts", run.starts}});
    document.update(run_json(done_, stage_seconds({}, done_, {{"write", write_seconds}})));
    return text_of(document);
}

std::string BoxReport::summary(double write_seconds) const {
    std::ostringstream out;
    out << "box           " << box_text(job_.box) << '\n'
        << "min distance  " << rounded(job_.box.min_distance, 6) << '\n'
        << "samples       " << samples_text(drawn()) << ", disks fill "
        << rounded(100 * density_, 3) << " %\n"
        << candidates_text(drawn(), job_.box.seed)
        << run_text(done_, stage_seconds({}, done_, {{"write", write_seconds}}), job_.out.output);
    return out.str();
}

} // namespace geodisk::tools
