#include "geodisk/reports/conformance_report.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include <geodisk/version.hpp>

#include "geodisk/commit.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/human_text.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

/// "2026-11-26", in universal time.
std::string today() {
    const std::chrono::year_month_day day{
        std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
    const auto two = [](unsigned value) { return (value < 10 ? "0" : "") + std::to_string(value); };
    return std::to_string(int(day.year())) + '-' + two(unsigned(day.month())) + '-' +
           two(unsigned(day.day()));
}

std::string verdict(const GoldenSet& set, const FoundSet& found) {
    if (!found.error.empty()) {
        return "failed: " + found.error;
    }
    return found.is(set) ? "same" : "different";
}

} // namespace

std::size_t ConformanceReport::same() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        if (found_[i].is(sets_[i])) {
            ++count;
        }
    }
    return count;
}

std::string ConformanceReport::json() const {
    Json sets = Json::array();
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const FoundSet& found = found_[i];
        const bool failed = !found.error.empty();
        sets.push_back({{"job", sets_[i].job},
                        {"same", found.is(sets_[i])},
                        {"expected_fingerprint", sets_[i].fingerprint},
                        {"expected_samples", sets_[i].samples},
                        {"fingerprint", failed ? Json(nullptr) : Json(found.fingerprint)},
                        {"samples", failed ? Json(nullptr) : Json(found.samples)},
                        {"chunks", failed ? Json(nullptr) : Json(found.chunks)},
                        {"sample_seconds", failed ? Json(nullptr) : Json(found.seconds)},
                        {"error", failed ? Json(found.error) : Json(nullptr)}});
    }
    Json device = device_json(device_);
    device["vendor_id"] = device_.vendor_id;
    device["device_id"] = device_.device_id;
    device["subgroup_size"] = device_.limits.subgroup_size;
    device["rounds_natively"] = device_.rounds_natively;
    return text_of(Json{{"geodisk_version", GEODISK_VERSION_STRING},
                        {"commit", kCommit},
                        {"date", today()},
                        {"device", std::move(device)},
                        {"tuning", tuning_json(tuning_)},
                        {"sets", sets_.size()},
                        {"same", same()},
                        {"results", std::move(sets)}});
}

std::string ConformanceReport::summary() const {
    Table table({"job", "samples", "fingerprint", "verdict"});
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const FoundSet& found = found_[i];
        const bool failed = !found.error.empty();
        table.add({sets_[i].job, failed ? "" : grouped(found.samples), found.fingerprint,
                   verdict(sets_[i], found)});
    }
    return "device  " + one_line(device_.name) + "\ndriver  " + one_line(driver_text(device_)) +
           "\n\n" + table.text() + '\n' + grouped(same()) + " of " + grouped(sets_.size()) +
           " sets are the same as on every other device\n";
}

std::string ConformanceReport::lines() const {
    std::string text;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const std::string samples = std::to_string(found_[i].samples);
        text += (found_[i].error.empty() ? found_[i].fingerprint : std::string(16, '?')) +
                std::string(9 - std::min<std::size_t>(8, samples.size()), ' ') + samples + "  " +
                sets_[i].job + '\n';
    }
    return text;
}

} // namespace geodisk::tools
