#include <geodisk/frame_neighbours.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/domain/surface_domain.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/job/sampler_impl.hpp"
#include "engine/neighbours/check_query.hpp"
#include "engine/neighbours/joined_vertices.hpp"
#include "engine/neighbours/neighbour_kernels.hpp"
#include "engine/neighbours/neighbour_memory.hpp"
#include "engine/neighbours/search_jobs.hpp"
#include "engine/run/frame_calls.hpp"
#include "engine/run/frame_growth.hpp"
#include "engine/run/frame_run.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"
#include "vk/barriers.hpp"

namespace geodisk {
namespace {

// Room for more pairs than expected.
constexpr double kSparePairs = 1.25;
constexpr double kMinPairs = 1024;
// Sources that the first lists have room for, until the number of pairs is known better.
constexpr double kFirstSources = 256;
// Bits in the mantissa of a length in double precision.
constexpr int kDoubleBits = 53;

Result<Done> check_options(const FrameNeighbourOptions& options) {
    if (options.dispatches == 0 || options.rounds == 0) {
        return invalid("FrameNeighbourOptions::dispatches and rounds must not be 0");
    }
    return check_frame_options("FrameNeighbourOptions", options);
}

/// Returns the largest float that is not above a length.
float float_below(double length) {
    const auto nearest = static_cast<float>(
        std::min(length, static_cast<double>(std::numeric_limits<float>::max())));
    return double{nearest} <= length ? nearest : std::nextafter(nearest, 0.0f);
}

/// Names each target by numbers of its own, as NeighbourInputs has them.
Result<std::vector<std::uint32_t>> names_of(std::span<const std::vector<std::uint32_t>> numbers) {
    std::vector<std::uint32_t> names(numbers.size() + 1);
    for (std::size_t target = 0; target < numbers.size(); ++target) {
        if (numbers[target].size() > gpu::kMaxNames) {
            return invalid(std::to_string(numbers[target].size()) +
                           " vertices are joined with vertex " + std::to_string(target) +
                           ", more than " + std::to_string(gpu::kMaxNames));
        }
        names[target] = static_cast<std::uint32_t>(names.size());
        names.insert(names.end(), numbers[target].begin(), numbers[target].end());
    }
    names[numbers.size()] = static_cast<std::uint32_t>(names.size());
    return names;
}

} // namespace

struct FrameNeighbours::Impl {
    /// Phase of the current part.
    enum class Phase : std::uint8_t {
        search, ///< Its disks are computed.
        group,  ///< The number of its entries is awaited.
        sort,   ///< Its rows are sorted.
        write,  ///< The number of its pairs is awaited.
    };
    struct Retired {
        std::unique_ptr<NeighbourMemory> memory;
        std::unique_ptr<NeighbourKernels> kernels;
        std::optional<ListMemory> lists;
    };

    std::shared_ptr<const Sampler> sampler;
    NeighbourQuery query;
    FrameNeighbourOptions options;
    SearchJobs jobs;
    PartSizes sizes;
    NeighbourInputs inputs;

    // Declared so that kernels are destroyed before the buffers.
    std::unique_ptr<NeighbourMemory> memory;
    std::optional<ListMemory> lists;
    std::unique_ptr<NeighbourKernels> kernels;
    FrameCalls<Retired> calls; ///< Calls of record_next().
    bool is_confirmed = false; ///< The host has seen that `memory` is uploaded.
    bool are_clear = false;    ///< True if the lists were emptied.

    Phase phase = Phase::search;
    bool begins = true;        ///< The part at hand is to begin.
    std::uint64_t awaited = 0; ///< Call whose copies tell of the phase.
    std::uint32_t part = 0;    ///< Sources of the part at hand.
    std::uint32_t step = 0;    ///< Passes of the phase so far.
    std::uint32_t merges = 0;  ///< Passes that sort the rows once.
    std::uint32_t hits = 0, entries = 0;
    std::uint32_t longest_chain = 0;
    bool trims = false;
    std::uint32_t ready = 0, pairs = 0;
    bool is_complete = false;

    Impl(std::shared_ptr<const Sampler> with, const NeighbourQuery& asked,
         const FrameNeighbourOptions& given, SearchJobs of)
        : sampler(std::move(with)), query(asked), options(given), jobs(std::move(of)),
          sizes(jobs.records_per_source()), calls(given.frames) {}

    const Sampler::Impl& engine() const { return Sampler::Impl::of(*sampler); }
    std::uint32_t count() const { return static_cast<std::uint32_t>(query.sources.size()); }

    Result<Done> take_inputs(const Domain& all, const PreparedMesh& mesh);
    /// Returns the room for records that the options ask for.
    std::uint32_t wanted_room() const;
    /// Allocates work memory, for parts of at least one source. `plan` is null for a new one.
    Result<Done> make_memory(std::uint32_t room, const RunPlan* plan);
    /// Allocates lists for so many pairs, for what they have at `commands`, if that is not null.
    Result<Done> make_lists(std::uint32_t least, VkCommandBuffer commands);
    Result<Done> make_kernels();
    void begin_part();

    gpu::NeighbourPush push() const;
    /// Returns what the latest copies tell, if they are of `call` or a later one.
    std::optional<NeighbourTold> told(std::uint32_t lag, std::uint64_t call) const;
    Result<bool> record_next(VkCommandBuffer commands, std::uint32_t lag);
    /// These record what the phase has to do, and return true if another phase follows in the same
    /// command buffer.
    Result<bool> record_phase(VkCommandBuffer commands, std::uint32_t lag);
    Result<bool> record_search(VkCommandBuffer commands, std::uint32_t lag);
    Result<bool> end_search(VkCommandBuffer commands, const NeighbourTold& now);
    Result<bool> record_group(const NeighbourTold& now);
    Result<bool> record_sort(VkCommandBuffer commands);
    Result<bool> record_write(VkCommandBuffer commands, const NeighbourTold& now);
    /// Takes fewer sources, or more room, for so many records.
    Result<Done> shrink(std::uint32_t records);
};

Result<Done> FrameNeighbours::Impl::take_inputs(const Domain& all, const PreparedMesh& mesh) {
    inputs.sources = Domain::Impl::of(all).settled;
    for (std::size_t i = 0; i < query.sources.size(); ++i) {
        inputs.limits.push_back(float_below(query.radii.empty() ? query.within : query.radii[i]));
    }
    std::vector<std::vector<std::uint32_t>> numbers;
    if (query.kind == NeighbourKind::vertices) {
        if (!lists_joined(query)) {
            return Done{};
        }
        numbers.resize(mesh.vertex_count());
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            numbers[query.joined[v]].push_back(v);
        }
    } else {
        for (const std::uint32_t number :
             static_cast<const SurfaceDomain&>(Domain::Impl::of(all)).target_numbers()) {
            numbers.push_back({number});
        }
    }
    auto names = names_of(numbers);
    GEODISK_TRY(names);
    inputs.names = std::move(*names);
    return Done{};
}

std::uint32_t FrameNeighbours::Impl::wanted_room() const {
    return static_cast<std::uint32_t>(std::clamp(
        static_cast<double>(options.record_bytes) / sizeof(gpu::HitRec), kMinRecords, kMaxRecords));
}

Result<Done> FrameNeighbours::Impl::make_memory(std::uint32_t room, const RunPlan* plan) {
    const std::size_t sources = sizes.sources(room, 1, count() - ready);
    const auto domain = jobs.job(ready, sources, room);
    GEODISK_TRY(domain);
    const auto planned =
        plan != nullptr ? Result<RunPlan>(*plan) : sampler->plan_run(*domain, options.pool_bytes);
    GEODISK_TRY(planned);
    auto made = NeighbourMemory::create(*sampler, *domain, *planned, room, inputs, options.frames);
    GEODISK_TRY(made);
    if (memory) {
        calls.retire({std::move(memory), std::move(kernels), std::nullopt});
    }
    memory = std::move(*made);
    calls.begin_memory();
    begin_part();
    return lists ? make_kernels() : Done{};
}

Result<Done> FrameNeighbours::Impl::make_lists(std::uint32_t least, VkCommandBuffer commands) {
    const double expected = ready > 0 ? kSparePairs * pairs / ready * count()
                                      : sizes.each() * std::min<double>(count(), kFirstSources);
    const double most =
        std::min(static_cast<double>(engine().report.limits.max_storage_buffer_range) / 4,
                 static_cast<double>(query.max_pairs) + kMinPairs);
    if (least > most) {
        return Error{Status::job_too_large,
                     std::to_string(least) + " neighbours are more than one buffer of " +
                         engine().report.name + " holds; take a smaller distance or fewer sources"};
    }
    const auto room = static_cast<std::uint32_t>(
        std::clamp(expected, std::max<double>(least, kMinPairs), std::max<double>(most, least)));
    auto made = ListMemory::create(*sampler, count(), room);
    GEODISK_TRY(made);
    if (lists && commands != VK_NULL_HANDLE) {
        made->record_copy(engine().vk, commands, *lists, pairs);
        calls.retire({nullptr, std::move(kernels), std::move(lists)});
    }
    lists.emplace(std::move(*made));
    return make_kernels();
}

Result<Done> FrameNeighbours::Impl::make_kernels() {
    NeighbourRanges ranges = memory->ranges();
    ranges.offsets = lists->offsets();
    ranges.targets = lists->targets();
    ranges.distances = lists->distances();
    auto made = NeighbourKernels::create(engine(), ranges);
    GEODISK_TRY(made);
    kernels = std::move(*made);
    return Done{};
}

void FrameNeighbours::Impl::begin_part() {
    const std::uint32_t left = count() - ready;
    part = static_cast<std::uint32_t>(sizes.sources(memory->room(), ready, left));
    part = std::min(part, memory->max_sources());
    Job::Impl::of(memory->job()).restart(part, query.radii.empty() ? 0 : part);
    phase = Phase::search;
    begins = true;
}

gpu::NeighbourPush FrameNeighbours::Impl::push() const {
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(
        std::ldexp(std::frexp(jobs.frame().unit, &exponent), kDoubleBits));
    gpu::NeighbourPush push{};
    push.count = phase == Phase::search ? hits : entries;
    push.capacity = memory->room();
    push.first_source = ready;
    push.sources = part;
    push.all_sources = count();
    push.longest_word = memory->longest_word();
    push.nearest = query.nearest;
    push.skips_own = query.kind == NeighbourKind::sources ? 1 : 0;
    push.has_names = inputs.names.empty() ? 0 : 1;
    push.pairs = lists->pairs();
    push.unit_low = static_cast<std::uint32_t>(mantissa);
    push.unit_high = static_cast<std::uint32_t>(mantissa >> 32);
    push.unit_exponent = exponent - kDoubleBits;
    return push;
}

std::optional<NeighbourTold> FrameNeighbours::Impl::told(std::uint32_t lag,
                                                         std::uint64_t call) const {
    if (!calls.is_uploaded() || !calls.has_completed(call, lag)) {
        return std::nullopt;
    }
    return memory->told(calls.place(lag));
}

Result<Done> FrameNeighbours::Impl::shrink(std::uint32_t records) {
    sizes.note(records, part);
    if (part == 1) {
        const RunPlan plan = memory->plan();
        return make_memory(sizes.room(1, 0), &plan);
    }
    begin_part();
    return Done{};
}

Result<bool> FrameNeighbours::Impl::end_search(VkCommandBuffer commands, const NeighbourTold& now) {
    if (now.head[0] > memory->room()) {
        const auto shrunk = shrink(now.head[0]);
        return shrunk ? Result<bool>(true) : shrunk.error();
    }
    sizes.note(now.head[0], part);
    hits = now.head[0];
    longest_chain = std::max(longest_chain, now.control.longest_chain);
    trims = trims || memory->plan().trims || memory->job().plan().trims;
    const DeviceTable& vk = engine().vk;
    barrier_compute_to_transfer(vk, commands);
    memory->record_clear_rows(vk, commands);
    barrier_transfer_to_compute(vk, commands);
    kernels->record_entries(commands, push());
    phase = Phase::group;
    awaited = calls.count();
    return false;
}

Result<bool> FrameNeighbours::Impl::record_search(VkCommandBuffer commands, std::uint32_t lag) {
    const DeviceTable& vk = engine().vk;
    if (!calls.is_uploaded()) {
        memory->record_upload(vk, commands);
        if (!are_clear) {
            lists->record_clear(vk, commands);
            are_clear = true;
        }
        calls.note_upload();
        is_confirmed = false;
        return false;
    }
    const auto now = told(lag, calls.upload());
    if (!is_confirmed) { // Nothing is to be dispatched by what memory happens to hold.
        if (now && now->head[1] != memory->room()) {
            return invalid(
                "the buffers hold no mesh: a command buffer with uploads was not submitted");
        }
        is_confirmed = now.has_value();
        if (!is_confirmed) {
            return false;
        }
    }
    auto grown = advance_or_grow(memory->job(), now ? now->control : gpu::ControlRec{},
                                 options.pool_bytes, engine().report);
    GEODISK_TRY(grown);
    const Advice& advice = grown->advice;
    if (grown->outgrown || advice.next == Next::larger_samples) {
        RunPlan plan = advice.plan;
        plan.sample_capacity = std::max(plan.sample_capacity, advice.sample_capacity);
        GEODISK_TRY(make_memory(memory->room(), &plan));
        return true;
    }
    Job& job = memory->job();
    if (std::exchange(begins, false)) {
        record_barrier(vk, commands, Sampler::kLastUse.stages, Sampler::kLastUse.access,
                       kCopies.stages, kCopies.access);
        memory->record_part(vk, commands, ready, part);
        record_barrier(vk, commands, kCopies.stages, kCopies.access, Sampler::kFirstUse.stages,
                       Sampler::kFirstUse.access);
    }
    switch (advice.next) {
    case Next::finish:
    case Next::complete: // No order of the sources is needed: they have one.
        return end_search(commands, *now);
    case Next::begin:
        if (!sampler->record_begin(commands, job, options.dispatches)) {
            return false;
        }
        break;
    case Next::larger_pool: // Within the same pool: fewer disks at a time, with more memory each.
        GEODISK_TRY(job.set_plan(advice.plan));
        sampler->record_rewind(commands, job);
        break;
    default:
        break;
    }
    sampler->record_rounds(commands, job, options.rounds);
    return false;
}

Result<bool> FrameNeighbours::Impl::record_group(const NeighbourTold& now) {
    if (now.entries > memory->room()) {
        const auto shrunk = shrink(now.entries);
        return shrunk ? Result<bool>(true) : shrunk.error();
    }
    entries = now.entries;
    // An even number, so that they end where they began.
    merges = static_cast<std::uint32_t>(std::bit_width(std::max(now.longest, 1u) - 1u));
    merges += merges & 1u;
    phase = Phase::sort;
    step = 0;
    return true;
}

Result<bool> FrameNeighbours::Impl::record_sort(VkCommandBuffer commands) {
    // By number, and for the nearest ones by distance.
    const std::uint32_t all = query.nearest != 0 ? 2 * merges : merges;
    for (std::uint32_t pass = 0; pass < options.dispatches && step < all; ++pass, ++step) {
        gpu::NeighbourPush own = push();
        if (step == merges) {
            kernels->record_mark(commands, own);
        }
        own.width = 1u << (step % merges);
        own.by_distance = step >= merges ? 1 : 0;
        kernels->record_merge(commands, own, (step & 1u) != 0);
    }
    if (step < all) {
        return false;
    }
    kernels->record_keep(commands, push());
    kernels->record_write(commands, push());
    phase = Phase::write;
    awaited = calls.count();
    return false;
}

Result<bool> FrameNeighbours::Impl::record_write(VkCommandBuffer commands,
                                                 const NeighbourTold& now) {
    const std::uint32_t done = ready + part;
    GEODISK_TRY(check_pairs(query, done, now.pairs));
    if (now.pairs > lists->pairs()) {
        const DeviceTable& vk = engine().vk;
        record_barrier(vk, commands, Sampler::kLastUse.stages, Sampler::kLastUse.access,
                       kCopies.stages, kCopies.access);
        GEODISK_TRY(make_lists(now.pairs, commands));
        record_barrier(vk, commands, kCopies.stages, kCopies.access, Sampler::kFirstUse.stages,
                       Sampler::kFirstUse.access);
        kernels->record_write(commands, push());
        awaited = calls.count();
        return false;
    }
    ready = done;
    pairs = now.pairs;
    is_complete = ready == count();
    if (!is_complete) {
        begin_part();
    }
    return !is_complete;
}

Result<bool> FrameNeighbours::Impl::record_phase(VkCommandBuffer commands, std::uint32_t lag) {
    if (phase == Phase::search) {
        return record_search(commands, lag);
    }
    if (phase == Phase::sort) {
        return record_sort(commands);
    }
    const auto now = told(lag, awaited);
    if (!now) {
        return false;
    }
    return phase == Phase::group ? record_group(*now) : record_write(commands, *now);
}

Result<bool> FrameNeighbours::Impl::record_next(VkCommandBuffer commands, std::uint32_t lag) {
    if (calls.free_unused(lag)) {
        memory->free_staging();
    }
    if (is_complete) {
        calls.end_call();
        return true;
    }
    const DeviceTable& vk = engine().vk;
    record_barrier(vk, commands, options.readers.stages | kCopies.stages | Sampler::kLastUse.stages,
                   kCopies.access | Sampler::kLastUse.access,
                   Sampler::kFirstUse.stages | kCopies.stages,
                   Sampler::kFirstUse.access | kCopies.access);
    for (;;) {
        const auto goes_on = record_phase(commands, lag);
        GEODISK_TRY(goes_on);
        if (!*goes_on) {
            break;
        }
    }
    record_barrier(vk, commands, Sampler::kLastUse.stages, Sampler::kLastUse.access,
                   kCopies.stages | options.readers.stages,
                   kCopies.access | options.readers.access);
    memory->record_told(vk, commands, *lists, ready, is_complete ? 0 : part, calls.place());
    barrier_transfer_to_host(vk, commands);
    calls.end_call();
    return is_complete;
}

Result<FrameNeighbours> FrameNeighbours::create(std::shared_ptr<const Sampler> sampler,
                                                const PreparedMesh& mesh,
                                                const NeighbourQuery& query,
                                                const FrameNeighbourOptions& options) noexcept {
    return guarded([&]() -> Result<FrameNeighbours> {
        if (!sampler) {
            return invalid("the sampler is null");
        }
        auto checked = check_options(options);
        checked = checked ? check_query(mesh, query) : checked;
        if (checked && !query.has_distances()) {
            checked = invalid("a search in frames needs the distance within which neighbours are");
        }
        GEODISK_TRY(checked);
        auto jobs = SearchJobs::create(mesh, query);
        GEODISK_TRY(jobs);
        auto impl = std::make_unique<Impl>(std::move(sampler), with_joined(mesh, query), options,
                                           std::move(*jobs));
        const auto all = impl->jobs.job(0, query.sources.size(), 0);
        GEODISK_TRY(all);
        auto made = impl->take_inputs(*all, mesh);
        made = made ? impl->make_memory(impl->wanted_room(), nullptr) : made;
        made = made ? impl->make_lists(0, VK_NULL_HANDLE) : made;
        GEODISK_TRY(made);
        return FrameNeighbours(std::move(impl));
    });
}

FrameNeighbours::FrameNeighbours(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
FrameNeighbours::FrameNeighbours(FrameNeighbours&&) noexcept = default;
FrameNeighbours& FrameNeighbours::operator=(FrameNeighbours&&) noexcept = default;
FrameNeighbours::~FrameNeighbours() = default;

Result<bool> FrameNeighbours::record(VkCommandBuffer commands) noexcept {
    return guarded([&]() -> Result<bool> {
        if (commands == VK_NULL_HANDLE) {
            return invalid("the command buffer is null");
        }
        return impl_->record_next(commands, impl_->options.frames);
    });
}

Result<Done> FrameNeighbours::find_and_wait(Runner& runner,
                                            const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<Done> {
        return run_frames(*impl_, runner, progress, [&] {
            return Progress{impl_->ready, impl_->count(), impl_->pairs, 0, 0};
        });
    });
}

FrameNeighbourLists FrameNeighbours::lists() const noexcept {
    const ListMemory& own = *impl_->lists;
    FrameNeighbourLists lists;
    lists.buffer = own.buffer();
    lists.offsets_offset = own.offsets().offset;
    lists.indices_offset = own.targets().offset;
    lists.distances_offset = own.distances().offset;
    lists.sources = impl_->count();
    lists.capacity = own.pairs();
    lists.ready = impl_->ready;
    lists.pairs = impl_->pairs;
    lists.is_complete = impl_->is_complete;
    const JobFrame& frame = impl_->jobs.frame();
    lists.error = ErrorModel(frame).error_of(impl_->longest_chain, impl_->trims) * frame.unit;
    return lists;
}

std::uint64_t FrameNeighbours::device_bytes() const noexcept {
    std::uint64_t bytes = impl_->memory->device_bytes() + impl_->lists->bytes();
    impl_->calls.for_retired([&](const Impl::Retired& old) {
        bytes += old.memory ? old.memory->device_bytes() : 0;
        bytes += old.lists ? old.lists->bytes() : 0;
    });
    return bytes;
}

} // namespace geodisk
