#include "engine/run/run_result.hpp"

#include <algorithm>

namespace geodisk {

void take_counts(const gpu::ControlRec& control, RunReport& report) {
    report.batches = control.batches;
    report.disks = control.disks;
    report.windows = wide(control.windows_low, control.windows_high);
    report.tested = wide(control.tested_low, control.tested_high);
    report.max_waiting = control.max_waiting;
    report.longest_chain = control.longest_chain;
    report.max_vertices = control.max_vertices;
    report.max_conflicts = control.max_conflicts;
    report.trips = wide(control.trips_low, control.trips_high);
    report.lane_trips = wide(control.lane_trips_low, control.lane_trips_high);
}

void RunReport::add(const RunReport& other) noexcept {
    // Several runs together may have more than fit.
    candidates += std::min(other.candidates, ~candidates);
    chunks += other.chunks;
    batches += other.batches;
    dispatches += other.dispatches;
    disks += other.disks;
    regrown += other.regrown;
    windows += other.windows;
    tested += other.tested;
    max_waiting = std::max(max_waiting, other.max_waiting);
    longest_chain = std::max(longest_chain, other.longest_chain);
    max_vertices = std::max(max_vertices, other.max_vertices);
    max_conflicts = std::max(max_conflicts, other.max_conflicts);
    trips += other.trips;
    lane_trips += other.lane_trips;
    guard = std::max(guard, other.guard);
    device_bytes = std::max(device_bytes, other.device_bytes);
    uploaded += other.uploaded;
    seconds.compile += other.seconds.compile;
    seconds.upload += other.seconds.upload;
    seconds.sample += other.seconds.sample;
    seconds.readback += other.seconds.readback;
    for (std::size_t stage = 0; stage < kStages; ++stage) {
        stages[stage] += other.stages[stage];
    }
}

SampleSet to_set(const Domain::Impl& domain, std::span<const gpu::SampleRec> records,
                 const RunReport& report) {
    SampleSet set{{}, {}, report, domain.settled.size() - domain.avoided, {}};
    records = records.subspan(domain.avoided);
    const std::size_t n = domain.dimension;
    set.samples.reserve(n == 0 ? records.size() : 0);
    set.points.resize(n * records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        const gpu::SampleRec& record = records[i];
        if (n > 0) {
            domain.coordinates(record, std::span(set.points).subspan(n * i, n));
        } else {
            set.samples.push_back(
                {record.face,
                 {1.0f - record.weight1 - record.weight2, record.weight1, record.weight2}});
        }
        if (domain.kernels.classes) {
            set.classes.push_back(static_cast<std::uint8_t>(record.order & gpu::kClassMask));
        }
    }
    return set;
}

} // namespace geodisk
