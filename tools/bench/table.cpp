#include "bench/table.hpp"

#include <algorithm>
#include <iostream>

#include "program/human_text.hpp"

namespace geodisk::bench {
namespace {

struct Column {
    const char* above;
    const char* name;
    std::size_t width;
    std::string (*text)(const Measurement& row);
};

std::string whole(double value) {
    return tools::fixed(value, 0);
}

std::string seconds(double value) {
    return tools::fixed(value, value < 100 ? 4 : 1);
}

/// Three significant digits, but never fewer than those before the point.
std::string three_digits(double value) {
    return tools::fixed(value, value < 1 ? 3 : value < 10 ? 2 : value < 100 ? 1 : 0);
}

constexpr std::size_t kNameWidth = 20;
constexpr std::size_t kCopiesWidth = 10;
constexpr Column kColumns[] = {
    {"", "faces", 8, [](const Measurement& r) { return std::to_string(r.triangles); }},
    {"", "samples", 8, [](const Measurement& r) { return std::to_string(r.samples); }},
    {"prepare", "s", 8, [](const Measurement& r) { return seconds(r.seconds.prepare); }},
    {"upload", "s", 8, [](const Measurement& r) { return seconds(r.seconds.upload); }},
    {"device", "s", 8, [](const Measurement& r) { return seconds(r.seconds.device); }},
    {"readback", "s", 8, [](const Measurement& r) { return seconds(r.seconds.readback); }},
    {"reference", "s", 9, [](const Measurement& r) { return seconds(r.seconds.reference); }},
    {"device", "/ref", 6,
     [](const Measurement& r) { return three_digits(r.seconds.device / r.seconds.reference); }},
    {"device", "sample/s", 8,
     [](const Measurement& r) { return whole(static_cast<double>(r.samples) / r.seconds.device); }},
    {"reference", "sample/s", 9,
     [](const Measurement& r) {
         return whole(static_cast<double>(r.samples) / r.seconds.reference);
     }},
    {"disk", "/sample", 7,
     [](const Measurement& r) { return three_digits(r.per_sample(r.run.disks)); }},
    {"window", "/disk", 7,
     [](const Measurement& r) {
         return three_digits(r.per_disk(static_cast<double>(r.run.windows)));
     }},
    {"tested", "/disk", 6,
     [](const Measurement& r) {
         return three_digits(r.per_disk(static_cast<double>(r.run.tested)));
     }},
    {"", "batches", 7, [](const Measurement& r) { return std::to_string(r.run.batches); }},
    {"", "waiting", 7, [](const Measurement& r) { return std::to_string(r.run.max_waiting); }},
    {"", "grown", 5, [](const Measurement& r) { return std::to_string(r.run.regrown); }},
    {"device", "MiB", 7,
     [](const Measurement& r) {
         return tools::fixed(static_cast<double>(r.run.device_bytes) / 1048576.0, 1);
     }},
    {"byte/", "candid.", 7, [](const Measurement& r) {
         return three_digits(static_cast<double>(r.run.device_bytes) / r.run.candidates);
     }}};

void append_right(std::string& line, const std::string& text, std::size_t width) {
    line.append(1 + width - std::min(width, text.size()), ' ');
    line += text;
}

std::string tuning_text(const Tuning& tuning) {
    return "batches " + std::to_string(tuning.batches) + ", local size " +
           std::to_string(tuning.local_size) + ", per slot " +
           std::to_string(tuning.slot_local_size) + ", pool block " +
           std::to_string(tuning.pool_block) + ", reads " + to_string(tuning.reads);
}

void print_circumstances(const Circumstances& run) {
    std::cout << "device     " << tools::one_line(run.device) << ", " << tools::one_line(run.driver)
              << "\nbuild      " << run.version << ", commit " << run.commit.substr(0, 12)
              << (run.is_dirty ? " with changes" : "") << ", " << run.build_type << ", "
              << run.compiler << "\ntuning     " << tuning_text(run.tuning) << '\n';
}

} // namespace

void print_heading(const Circumstances& run) {
    print_circumstances(run);
    std::string upper(kNameWidth, ' ');
    std::string lower = tools::padded("mesh", kNameWidth);
    for (const Column& column : kColumns) {
        append_right(upper, column.above, column.width);
        append_right(lower, column.name, column.width);
    }
    std::cout << "reference  sequential, double precision, on " << tools::one_line(run.cpu) << ", "
              << run.cores << " cores\nseconds    medians of " << run.repeats << " runs after "
              << run.warm_ups << " to warm up; the sets were equal\n\n"
              << upper << '\n'
              << lower << '\n'
              << std::flush;
}

void print_row(const Measurement& row) {
    std::string line = tools::padded(tools::one_line(row.mesh), kNameWidth);
    for (const Column& column : kColumns) {
        append_right(line, column.text(row), column.width);
    }
    std::cout << line << '\n';
    // All 0 unless asked for.
    if (row.run.stages[static_cast<std::size_t>(Stage::detect)] > 0) {
        std::cout << "  stages";
        for (std::size_t stage = 0; stage < kStages; ++stage) {
            std::cout << "  " << to_string(static_cast<Stage>(stage)) << ' '
                      << seconds(row.run.stages[stage]);
        }
        const double waited =
            1 - static_cast<double>(row.run.trips) / static_cast<double>(row.run.lane_trips);
        std::cout << "  lanes waiting " << tools::fixed(100 * waited, 0) << " %\n";
    }
    std::cout << std::flush;
}

void print_growth(const Series& series) {
    for (const Growth& growth : series.growth) {
        std::cout << "  " << growth.quantity << " time of " << tools::one_line(series.mesh);
        if (growth.law) {
            std::cout << " ~ " << to_string(series.sweep) << "^"
                      << tools::fixed(growth.law->exponent, 3) << " from "
                      << tools::grouped(static_cast<std::uint64_t>(growth.law->from)) << " on  (R2 "
                      << tools::fixed(growth.law->r_squared, 3) << ", " << growth.law->points
                      << " points)\n";
        } else {
            std::cout << ": too few steps to fit an exponent\n";
        }
    }
    std::cout << std::flush;
}

void print_copies_heading(const Circumstances& run) {
    print_circumstances(run);
    std::cout << "seconds    medians of " << run.repeats << " runs after " << run.warm_ups
              << " to warm up, from upload to result; each copy got the same samples in one job as "
                 "by itself\n\n"
              << tools::padded("mesh", kNameWidth);
    std::string line;
    for (const char* name : {"faces", "samples", "one by one", "one job", "one mesh", "job/mesh"}) {
        append_right(line, name, kCopiesWidth);
    }
    std::cout << line << '\n' << std::flush;
}

void print_copies(const CopiesRow& row) {
    std::string line = tools::padded(tools::one_line(row.mesh), kNameWidth);
    for (const std::string& text : {std::to_string(row.triangles), std::to_string(row.samples),
                                    seconds(row.seconds.one_by_one), seconds(row.seconds.one_job),
                                    seconds(row.seconds.one_mesh),
                                    three_digits(row.seconds.one_job / row.seconds.one_mesh)}) {
        append_right(line, text, kCopiesWidth);
    }
    std::cout << line << '\n' << std::flush;
}

void print_tune_heading(const Circumstances& run) {
    print_circumstances(run);
    std::cout << "ratio      device time over that of the best so far, medians of " << run.repeats
              << " runs in turn\n\n"
              << std::flush;
}

void print_trial(const Trial& trial) {
    std::string line = tools::padded(trial.setting, kNameWidth);
    append_right(line, tools::fixed(trial.ratio, 3), 8);
    std::cout << line << (trial.is_kept ? "  kept\n" : "\n") << std::flush;
}

void print_tuning(const Tuning& tuning, const std::string& path) {
    std::cout << "\nfound      " << tuning_text(tuning) << "\nkept in    " << tools::one_line(path)
              << '\n'
              << std::flush;
}

} // namespace geodisk::bench
