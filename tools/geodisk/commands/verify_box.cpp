#include <algorithm>
#include <sstream>

#include <geodisk/box.hpp>
#include <geodisk/version.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/verify.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::size_t count_outside(const BoxParams& box, const SampleFile& samples) {
    return static_cast<std::size_t>(
        std::count_if(samples.rows.begin(), samples.rows.end(), [&](const SampleRow& row) {
            bool outside = false;
            for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
                outside |= !(row.position[axis] >= 0 && row.position[axis] <= box.extents[axis]);
            }
            return outside;
        }));
}

std::string result_text(const SampleFile& samples, const BoxCheck& check) {
    const auto& [box, outside, result] = check;
    std::ostringstream out;
    out << "box           " << box_text(box) << '\n'
        << "samples       " << grouped(samples.rows.size()) << " in " << one_line(samples.path)
        << '\n'
        << "min distance  " << rounded(box.min_distance, 9) << '\n'
        << "smallest      " << smallest_text(result, box.min_distance) << '\n';
    print_violations(out, samples, result, "");
    if (outside > 0) {
        out << "outside       " << grouped(outside) << '\n';
    }
    return out.str();
}

} // namespace

BoxCheck check_box(const std::string& min_distance, const SampleFile& samples,
                   ProgressLine& progress) {
    const BoxParams box = box_of(min_distance, samples);
    return {box, count_outside(box, samples), check_box_spacing(box, samples.rows, progress)};
}

std::string report_json(const SampleFile& samples, const BoxCheck& check) {
    const auto& [box, outside, result] = check;
    return text_of(Json{{"version", GEODISK_VERSION_STRING},
                        {"box", {{"extents", box.extents}, {"periodic", box.is_periodic}}},
                        {"samples_file", samples.path},
                        {"samples", samples.rows.size()},
                        {"min_distance", box.min_distance},
                        {"cut", result.cut * box.min_distance},
                        {"smallest", pair_json(result.closest)},
                        {"smallest_ratio", result.closest ? Json(result.closest->ratio) : Json()},
                        {"violations", violations_json(result)},
                        {"outside", outside}});
}

void verify_box(const std::string& path, const std::string& min_distance,
                const OutputOptions& out) {
    check_outputs(out, "", {{"the samples", path}});
    ProgressLine progress(out.quiet);
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_box_samples(path);
    progress.clear();
    const BoxCheck check = check_box(min_distance, samples, progress);
    const auto& [box, outside, result] = check;
    publish(out, report_json(samples, check), result_text(samples, check));
    std::string message = violation_text(result, rounded(box.min_distance, 9));
    if (outside > 0) {
        message += (message.empty() ? "" : ", and ") + counted(outside, "sample", "samples") +
                   (outside == 1 ? " lies" : " lie") + " outside the box";
    }
    if (!message.empty()) {
        throw UserError(ExitCode::violation, path + ": " + message);
    }
}

} // namespace geodisk::tools
