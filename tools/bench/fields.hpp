// The names and values that every written form of a row and of the circumstances has, in order.
#pragma once

#include <string>

#include "bench/circumstances.hpp"
#include "bench/measurement.hpp"

namespace geodisk::bench {

/// Calls `visit(name, value)` for each; values are strings or numbers.
template <class Visit>
void visit_fields(const Measurement& row, const Visit& visit) {
    const RunReport& run = row.run;
    visit("mesh", row.mesh);
    visit("triangles", row.triangles);
    visit("count", row.wanted);
    visit("samples", row.samples);
    visit("candidates", run.candidates);
    visit("min_distance", row.min_distance);
    visit("prepare_seconds", row.seconds.prepare);
    visit("upload_seconds", row.seconds.upload);
    visit("device_seconds", row.seconds.device);
    visit("readback_seconds", row.seconds.readback);
    visit("reference_seconds", row.seconds.reference);
    visit("device_per_reference", row.seconds.device / row.seconds.reference);
    visit("device_samples_per_second", static_cast<double>(row.samples) / row.seconds.device);
    visit("reference_samples_per_second", static_cast<double>(row.samples) / row.seconds.reference);
    for (std::size_t stage = 0; stage < kStages; ++stage) {
        // 0 unless stages are timed.
        const std::string name = to_string(static_cast<Stage>(stage));
        visit((name + "_stage_seconds").c_str(), run.stages[stage]);
    }
    visit("disks_per_sample", row.per_sample(static_cast<double>(run.disks)));
    visit("windows_per_disk", row.per_disk(static_cast<double>(run.windows)));
    visit("tested_per_disk", row.per_disk(static_cast<double>(run.tested)));
    visit("disks", run.disks);
    visit("windows", run.windows);
    visit("tested", run.tested);
    visit("trips", run.trips);           // 0 unless stages are timed,
    visit("lane_trips", run.lane_trips); // and so is this.
    visit("iterations", run.iterations);
    visit("dispatches", run.dispatches);
    visit("regrown", run.regrown);
    visit("most_waiting", run.most_waiting);
    visit("longest_chain", run.longest_chain);
    visit("device_bytes", run.device_bytes);
    visit("bytes_per_candidate",
          static_cast<double>(run.device_bytes) / static_cast<double>(run.candidates));
}

template <class Visit>
void visit_fields(const Circumstances& run, const Visit& visit) {
    visit("version", run.version);
    visit("commit", run.commit);
    visit("dirty", run.is_dirty);
    visit("build_type", run.build_type);
    visit("compiler", run.compiler);
    visit("device", run.device);
    visit("driver", run.driver);
    visit("device_type", run.device_type);
    visit("cpu", run.cpu);
    visit("cores", run.cores);
    visit("date", run.date);
    visit("repeats", run.repeats);
    visit("warm_ups", run.warm_ups);
    visit("slots", run.slots);
    visit("lanes", run.lanes);
    visit("steps", run.steps);
    visit("passes", run.passes);
    visit("batches", run.tuning.batches);
    visit("local_size", run.tuning.local_size);
    visit("slot_local_size", run.tuning.slot_local_size);
    visit("pool_block", run.tuning.pool_block);
    visit("reads", std::string(to_string(run.tuning.reads)));
}

} // namespace geodisk::bench
