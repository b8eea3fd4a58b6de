#include "parts/sample_parts.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/domain/existing.hpp"
#include "engine/domain/listed.hpp"
#include "parts/cut.hpp"
#include "parts/decide_stages.hpp"
#include "parts/part.hpp"
#include "parts/part_run.hpp"
#include "parts/peak_memory.hpp"
#include "support/free_memory.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Final report of a process to the first one, before its samples.
struct Summary {
    ProcessReport process;
    RunReport run;
};
static_assert(std::is_trivially_copyable_v<Summary>);

template <class T>
const Error* error_of(const Result<T>& result) {
    return result ? nullptr : &result.error();
}

Result<std::vector<Bytes>> parts_of(const WholeSurface& whole, std::uint32_t processes) {
    return guarded([&]() -> Result<std::vector<Bytes>> {
        GEODISK_TRY(check_processes(whole.mesh, processes));
        // Before the cut, which relies on them.
        const auto frame = whole.frame != nullptr ? Result<JobFrame>(*whole.frame)
                                                  : frame_of(whole.mesh, whole.params);
        GEODISK_TRY(frame);
        const auto owners = whole.cut(whole.mesh, whole.params, processes);
        return owners ? divide(whole, *frame, *owners, processes)
                      : Result<std::vector<Bytes>>(owners.error());
    });
}

/// Returns the samples of all processes as one run gives them.
std::vector<Sample> merged(const SampleParams& params, const Darts& darts) {
    std::vector<Sample> samples;
    samples.reserve(params.existing.size() + darts.size());
    for (const Sample& sample : params.existing) {
        const auto [weight1, weight2] = rounded_weights(sample.weights);
        samples.push_back({sample.face, {1.0f - weight1 - weight2, weight1, weight2}});
    }
    for (const DrawnCandidate& dart : darts) {
        samples.push_back(to_sample(dart.point));
    }
    return samples;
}

/// Returns the classes of these samples.
std::vector<std::uint8_t> merged_classes(const SampleParams& params, const Darts& darts) {
    std::vector<std::uint8_t> classes(params.existing_classes.begin(),
                                      params.existing_classes.end());
    classes.resize(params.existing.size());
    std::ranges::transform(darts, std::back_inserter(classes), class_of);
    return classes;
}

/// Adds the share of a part to that of its process.
void add(ProcessReport& process, const ProcessReport& part) {
    process.parts += part.parts;
    process.own_faces += part.own_faces;
    process.faces += part.faces;
    process.candidates += part.candidates;
    process.samples += part.samples;
    process.part_bytes += part.part_bytes;
    process.messages += part.messages;
    process.bytes += part.bytes;
    process.rounds = part.rounds;
    process.neighbours += part.neighbours;
    process.whole_runs += part.whole_runs;
    process.border_runs += part.border_runs;
    process.peak_bytes = std::max(process.peak_bytes, part.peak_bytes);
}

/// Puts together what the parts tell; the first of `darts` are samples.
SharedSamples put_together(const Exchange& exchange, const SampleParams& params,
                           const std::vector<Bytes>& messages, Darts& darts) {
    SharedSamples result;
    result.processes.resize(exchange.process_of(exchange.size() - 1) + 1);
    RunReport& run = result.set.report;
    for (std::uint32_t rank = 0; rank < exchange.size(); ++rank) {
        const Bytes& message = messages[rank];
        Summary summary;
        std::memcpy(&summary, message.data(), sizeof summary);
        const Darts own = darts_of(std::span(message).subspan(sizeof summary));
        darts.insert(darts.end(), own.begin(), own.end());
        if (rank == 0) {
            run = summary.run;
        } else {
            const RunSeconds seconds = run.seconds;
            run.add(summary.run);
            if (exchange.process_of(rank) != 0) { // It worked at the same time.
                run.seconds = seconds;
            }
            run.starts += summary.run.starts;
        }
        add(result.processes[exchange.process_of(rank)], summary.process);
    }
    std::ranges::sort(darts, DartOrder{!params.face_keys.empty()});
    const std::size_t existing = params.existing.size();
    if (params.stop_count != 0) {
        darts.resize(std::min<std::size_t>(darts.size(), params.stop_count - existing));
    }
    result.set.existing = existing;
    result.set.samples = merged(params, darts);
    if (!params.class_factors.empty()) {
        result.set.classes = merged_classes(params, darts);
    }
    return result;
}

/// Returns the candidates of all processes up to the last sample; `last` is known to the first.
Result<std::uint64_t> candidates_up_to(Exchange& exchange, const PartRun& run,
                                       const DrawnCandidate& last) {
    Bytes told;
    append(told, std::span(&last, 1));
    const auto heard = exchange.broadcast(told);
    GEODISK_TRY(heard);
    const DrawnCandidate end = darts_of(*heard).front();
    return exchange.sum(run.own_up_to(end.stage, end.priority));
}

/// Gives each part the samples of the checkpoint that it goes on from, which the first process
/// alone has.
Result<Done> settle(Exchange& exchange, Part& part, const Checkpoints* checkpoints) {
    constexpr std::size_t kBytesAtOnce = std::size_t{1} << 26; // Of the messages to all.
    const std::size_t at_once =
        std::max<std::size_t>(1, kBytesAtOnce / sizeof(DrawnCandidate) / exchange.size());
    const std::size_t count = part.checkpoints.samples;
    for (std::size_t begin = 0; begin < count; begin += at_once) {
        Bytes told;
        if (checkpoints != nullptr) {
            append(told, std::span(checkpoints->from->samples)
                             .subspan(begin, std::min(at_once, count - begin)));
        }
        const auto heard = exchange.broadcast(told);
        GEODISK_TRY(heard);
        for (const DrawnCandidate& dart : darts_of(*heard)) {
            if (part.has(dart.point.face) &&
                part.roles[part.local(dart.point.face)] != FaceRole::surface) {
                part.settled.push_back(dart);
            }
        }
    }
    return Done{};
}

/// Samples the parts of all processes. `params` are those of the whole, null on all but the first
/// process, and so are checkpoints, or for a job without any.
Result<SharedSamples> sample_all(Exchange& exchange, Runner& runner,
                                 const Result<std::unique_ptr<Part>>& part,
                                 std::uint64_t part_bytes, const SampleParams* params,
                                 const Checkpoints* given, const ProgressCallback& progress) {
    Summary summary;
    summary.process.parts = 1;
    summary.process.part_bytes = part_bytes;
    std::optional<PartRun> run;
    const auto begun = guarded([&]() -> Result<Done> {
        GEODISK_TRY(part);
        run.emplace(exchange, **part, runner, progress);
        return Done{};
    });
    GEODISK_TRY(exchange.check_all(error_of(begun)));
    const Checkpoints none;
    const Checkpoints& checkpoints = given != nullptr ? *given : none;
    Checkpoint reached = checkpoints.from != nullptr ? *checkpoints.from : Checkpoint();
    const auto stages = decide_stages(exchange, **part, *run, reached, checkpoints.save);
    GEODISK_TRY(stages);
    const Darts own = run->samples();
    ProcessReport& report = summary.process;
    report.own_faces =
        static_cast<std::uint64_t>(std::ranges::count((*part)->roles, FaceRole::own));
    report.faces = (*part)->faces.size();
    report.candidates = stages->own_candidates;
    report.samples = own.size();
    report.messages = stages->agreement.messages;
    report.bytes = stages->agreement.bytes;
    report.rounds = stages->agreement.rounds;
    report.neighbours = static_cast<std::uint32_t>((*part)->neighbours.size());
    report.whole_runs = run->whole_runs();
    report.border_runs = run->border_runs();
    report.peak_bytes = peak_memory();
    summary.run = run->report();
    Bytes told(sizeof summary);
    std::memcpy(told.data(), &summary, sizeof summary);
    append(told, own);
    const auto all = exchange.gather(std::move(told));
    GEODISK_TRY(all);
    SharedSamples result;
    Darts darts;
    if (params != nullptr) {
        result = put_together(exchange, *params, *all, darts);
    }
    std::uint64_t candidates = stages->candidates;
    if (stages->is_stopped) {
        const auto last =
            candidates_up_to(exchange, *run, darts.empty() ? DrawnCandidate() : darts.back());
        GEODISK_TRY(last);
        candidates = stages->before + *last;
    }
    result.set.report.candidates = static_cast<std::uint32_t>(candidates);
    if ((*part)->checkpoints.is_saved) {
        reached = {kNoStage, candidates, std::move(darts)};
        GEODISK_TRY(save_on_first(exchange, reached, checkpoints.save));
    }
    return result;
}

} // namespace

Result<SharedSamples> sample_parts(Exchange& exchange, Runner& runner, const WholeSurface* whole,
                                   const ProgressCallback& progress) {
    Result<std::vector<Bytes>> parts = std::vector<Bytes>();
    const bool is_first = exchange.rank() == 0;
    if (is_first) {
        parts = parts_of(*whole, exchange.size());
    }
    GEODISK_TRY(exchange.check_all(error_of(parts)));
    auto message = exchange.scatter(std::move(*parts));
    GEODISK_TRY(message);
    const auto part = part_of(*message);
    const std::uint64_t bytes = message->size();
    free_memory(*message);
    if (part && whole != nullptr && whole->is_shared) {
        (*part)->of_mesh = &whole->mesh;
        (*part)->of_radii = whole->params.radii;
    }
    return sample_all(exchange, runner, part, bytes, is_first ? &whole->params : nullptr,
                      is_first ? whole->checkpoints : nullptr, progress);
}

Result<SharedSamples> sample_ranges(Exchange& exchange, Runner& runner,
                                    const RangedSurface& surface, const SampleParams& params,
                                    const Checkpoints* checkpoints,
                                    const ProgressCallback& progress, double max_candidates) {
    const auto frame = surface.frame(params);
    GEODISK_TRY(frame);
    const auto terms = exchange.all_gather(CheckpointTerms(checkpoints));
    GEODISK_TRY(terms);
    const auto part = surface.part(exchange, params, *frame, max_candidates, terms->front());
    GEODISK_TRY(part);
    GEODISK_TRY(settle(exchange, **part, checkpoints));
    return sample_all(exchange, runner, part, 0, exchange.rank() == 0 ? &params : nullptr,
                      checkpoints, progress);
}

} // namespace geodisk
