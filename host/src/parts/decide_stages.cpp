#include "parts/decide_stages.hpp"

#include <algorithm>
#include <optional>

#include "constants.h"
#include "engine/job/order_cut.hpp"
#include "parts/mesh_turn.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Leaves out all but the first candidates of a stage with so many on all processes. Returns how
/// many there are left: a few more where several share the last priority.
Result<std::uint64_t> keep_first(Exchange& exchange, PartRun& run, std::uint32_t stage,
                                 std::uint64_t drawn, std::uint64_t wanted) {
    OrderCut cut(1u << gpu::kPriorityBits, static_cast<std::uint32_t>(drawn),
                 static_cast<std::uint32_t>(wanted));
    while (!cut.is_found()) {
        const auto below = exchange.sum(run.own_up_to(stage, cut.guess() - 1));
        GEODISK_TRY(below);
        cut.note(static_cast<std::uint32_t>(*below));
    }
    run.end_at(cut.end() - 1);
    return cut.count();
}

/// Draws the candidates of stages, and decides those of pools. Returns how many all processes have
/// that take part.
Result<std::uint64_t> draw(Exchange& exchange, Part& part, PartRun& run, std::uint64_t drawn,
                           std::uint32_t first, std::uint32_t count) {
    const auto begun = guarded([&]() -> Result<Done> {
        const MeshTurn turn(exchange, part);
        run.begin(first, count);
        if (run.stages().is_counted()) {
            return Done{}; // Candidates may still be left out.
        }
        // Else the mesh would soon be made once more.
        const auto own = run.decide_first();
        return own ? Result<Done>(Done{}) : own.error();
    });
    GEODISK_TRY(exchange.check_all(begun ? nullptr : &begun.error()));
    const auto all = exchange.sum(run.own_candidates());
    const std::uint64_t wanted = run.stages().still_wanted(drawn);
    return all && *all > wanted ? keep_first(exchange, run, first, *all, wanted) : all;
}

Result<Darts> decide(Exchange& exchange, Part& part, PartRun& run, const Darts* near) {
    return guarded([&]() -> Result<Darts> {
        if (near == nullptr) {
            std::optional<MeshTurn> turn;
            if (!run.is_decided()) {
                turn.emplace(exchange, part);
            }
            return run.decide_first();
        }
        if (!run.has_to_decide(*near)) {
            return run.decided(*near);
        }
        {
            const MeshTurn turn(exchange, run.border());
            auto own = run.decide_border(*near);
            GEODISK_TRY(own);
            if (*own) {
                return std::move(**own);
            }
        }
        const MeshTurn turn(exchange, part);
        return run.decide_all(*near);
    });
}

} // namespace

Result<StagesReport> decide_stages(Exchange& exchange, Part& part, PartRun& run,
                                   Checkpoint& reached, const SaveCheckpoint& save) {
    StagesReport report;
    report.candidates = part.checkpoints.candidates;
    const Stages& stages = run.stages();
    std::uint64_t accepted = part.all_existing + part.checkpoints.samples;
    std::uint32_t first = part.checkpoints.first_stage;
    const auto is_enough = [&] {
        return part.of_whole.stop_count != 0 && accepted >= part.of_whole.stop_count;
    };
    const auto has_more = [&] {
        return first != kNoStage && !is_enough() && stages.left(first, report.candidates) > 0;
    };
    while (has_more()) {
        const std::uint32_t count =
            std::min(part.max_stages, stages.left(first, report.candidates));
        const auto drawn = draw(exchange, part, run, report.candidates, first, count);
        GEODISK_TRY(drawn);
        const auto own = agree(
            exchange, part, [&](const Darts* near) { return decide(exchange, part, run, near); },
            report.agreement);
        GEODISK_TRY(own);
        const auto more = exchange.sum(own->size());
        GEODISK_TRY(more);
        accepted += *more;
        report.own_candidates += run.own_candidates();
        report.before = report.candidates;
        report.candidates += *drawn;
        report.is_stopped = is_enough();
        first += count;
        if (part.checkpoints.is_saved && has_more()) {
            reached.first_stage = first;
            reached.candidates = report.candidates;
            GEODISK_TRY(save_stages(exchange, *own, reached, part.has_keys, save));
        }
    }
    return report;
}

} // namespace geodisk
