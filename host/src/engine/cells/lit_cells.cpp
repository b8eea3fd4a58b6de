#include "engine/cells/lit_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "engine/cells/open_cells.hpp"
#include "engine/domain/surface_domain.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/run/run.hpp"
#include "mesh/extent.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Samples whose disks tell how many records there will be.
constexpr std::size_t kFewSamples = 64;
// Disks begin no smaller, in parts of those that cover the surface if samples are even.
constexpr double kSmallest = 0x1p-10;
constexpr double kGrowth = 1.5;
// Far more than the rounding of one path's length, if not than its bound for the longest chains.
constexpr double kTie = 0x1p-19;
// Part of the faces that a first disk covers, times the samples. It may have more records than
// twice.
constexpr double kFacesPerDisk = 2.5;
// Maximum of records read at once and of disks of a job, and room for more than expected.
constexpr double kMaxRecords = 0x1p21;
constexpr double kMaxDisks = 0x1p20;
constexpr double kSpareRecords = 1.5;
constexpr double kMinRecords = 4096;

} // namespace

LitCells::LitCells(Runner::Impl& runner, const PreparedMesh& mesh, std::span<const Sample> samples,
                   const SampleParams& params, const JobFrame& frame, const CellParams& cells)
    : runner_(runner), mesh_(mesh), samples_(samples), params_(params), frame_(frame),
      cells_(cells),
      lit_(mesh, params, frame, double{ErrorModel(frame).tolerances(frame.error_bound).slack}),
      radii_(samples.size(), 1),
      records_per_disk_(2.0 * mesh.face_count() *
                        std::min(1.0, kFacesPerDisk / static_cast<double>(samples.size()))),
      left_(samples.size()), parts_(mesh, frame) {}

double LitCells::largest_radius() const {
    return *std::ranges::max_element(radii_);
}

double LitCells::smallest_radius() const {
    return *std::ranges::min_element(radii_);
}

Closeness LitCells::closeness() const {
    return {ErrorModel(frame_).error_of(report_.longest_chain, report_.plan.trims),
            kTie * std::max(1.0, 2 * largest_radius())};
}

Progress LitCells::so_far(const Progress& now) const {
    const auto all = static_cast<std::uint32_t>(samples_.size());
    const auto done = all - static_cast<std::uint32_t>(left_) + now.disks;
    return {std::min(done, all), 2 * all, std::min(done, all), report_.disks + now.disks,
            report_.windows + now.windows};
}

Error LitCells::too_many(double records) const {
    return {Status::job_too_large, "the cells take about " + number_text(records) +
                                       " records of paths, more than the " +
                                       std::to_string(cells_.max_records) +
                                       " that are allowed; take fewer samples or a simpler mesh"};
}

Task<Result<std::size_t>> LitCells::some_disks(std::span<const std::uint32_t> samples,
                                               const NearPart* near, const TakeLights& take) {
    const double wanted = kSpareRecords * records_per_disk_;
    const double most = std::min(kMaxRecords, runner_.record_bytes() / sizeof(gpu::LitRec));
    const double count = std::floor(
        std::clamp(std::min(most / wanted, kMaxDisks), 1.0, static_cast<double>(samples.size())));
    const double largest =
        static_cast<double>(runner_.engine().report.limits.max_storage_buffer_range) /
            sizeof(gpu::LitRec) -
        1;
    // A single disk takes all there is where need be.
    const double room = std::min(wanted * count + kMinRecords, std::floor(largest));
    if (room < records_per_disk_ * count) {
        co_return Error{Status::job_too_large,
                        "the disk of a sample has about " + number_text(records_per_disk_) +
                            " records of paths, more than this device binds; "
                            "take more samples or a simpler mesh"};
    }
    std::vector<KeepOut> disks;
    double reach = 0;
    for (const std::uint32_t sample : samples.first(static_cast<std::size_t>(count))) {
        disks.push_back({samples_[sample], radii_[sample] * frame_.unit});
        reach = std::max(reach, disks.back().radius);
        std::uint32_t& face = disks.back().center.face;
        face = near != nullptr ? near->local.of(face) : face;
    }
    SampleParams params = params_;
    params.avoid = disks;
    const auto domain =
        SurfaceDomain::recording(near != nullptr ? *near->mesh : mesh_, params, frame_,
                                 Ending::light, {}, static_cast<std::uint32_t>(room));
    GEODISK_CO_TRY(domain);
    DiskRecords records;
    const auto recorded = co_await run_job(runner_, *domain, &records);
    if (!recorded) {
        parts_.note_failed(runner_, *domain, reach);
        co_return recorded.error();
    }
    report_.add(recorded->report);
    report_.plan.trims |= recorded->report.plan.trims;
    records_per_disk_ = std::max(records_per_disk_, records.wanted / count);
    if (records.wanted > records.lights.size()) {
        co_return 0;
    }
    for (gpu::LitRec& record : records.lights) {
        record.sample_index = samples[record.sample_index];
        // The device adds to it what the error bound of its run asks for.
        record.limit = static_cast<float>(-radii_[record.sample_index]);
        if (near != nullptr) {
            record.place = near->half_edge(record.place >> 1) << 1 | (record.place & 1);
        }
    }
    take(records.lights);
    co_return disks.size();
}

Task<Result<Done>> LitCells::disks_on(const NearPart* near, std::span<const std::uint32_t> samples,
                                      const TakeLights& take) {
    while (!samples.empty()) {
        const auto done = co_await some_disks(samples, near, take);
        GEODISK_CO_TRY(done);
        samples = samples.subspan(*done);
        left_ -= *done;
        const std::size_t computed = std::max<std::size_t>(1, wanted_ - left_);
        const double of_all = static_cast<double>(wanted_) / static_cast<double>(computed);
        if (lit_.size() > cells_.max_records) {
            co_return too_many(static_cast<double>(lit_.size()) * of_all);
        }
    }
    co_return Done{};
}

Task<Result<Done>> LitCells::disks_in_parts(std::span<const std::uint32_t> samples,
                                            const TakeLights& take) {
    for (std::uint32_t part = 0; part < parts_.count(); ++part) {
        std::vector<std::uint32_t> own;
        double reach = 0;
        for (const std::uint32_t sample : samples) {
            if (parts_.has(part, samples_[sample].face)) {
                own.push_back(sample);
                reach = std::max(reach, radii_[sample] * frame_.unit);
            }
        }
        if (!own.empty()) {
            const auto near = parts_.near(part, reach);
            GEODISK_CO_TRY(near);
            GEODISK_CO_TRY(co_await disks_on(&*near, own, take));
        }
    }
    co_return Done{};
}

Task<Result<Done>> LitCells::all_disks(std::span<const std::uint32_t> samples,
                                       const TakeLights& take) {
    wanted_ = samples.size();
    for (;;) {
        left_ = wanted_;
        auto computed =
            parts_.count() == 0 ? disks_on(nullptr, samples, take) : disks_in_parts(samples, take);
        const auto done = co_await computed;
        if (done || !parts_.divide(done.error())) { // Lights that come twice count once.
            co_return done;
        }
    }
}

Task<Result<Done>> LitCells::choose_radii() {
    if (samples_.size() <= kFewSamples) {
        co_return Done{};
    }
    std::vector<std::uint32_t> few;
    for (std::size_t i = 0; i < kFewSamples; ++i) {
        few.push_back(static_cast<std::uint32_t>(i * samples_.size() / kFewSamples));
    }
    const double part = static_cast<double>(kFewSamples) / static_cast<double>(samples_.size());
    for (double radius = 1;; radius /= 2) {
        std::ranges::fill(radii_, radius);
        records_per_disk_ = 1;
        double all = 0;
        const TakeLights count = [&](std::span<const gpu::LitRec> lights) {
            all += static_cast<double>(lights.size()) / part;
        };
        GEODISK_CO_TRY(co_await all_disks(few, count));
        if (all <= static_cast<double>(cells_.max_records)) {
            co_return Done{};
        }
        if (radius <= kSmallest) {
            co_return too_many(all);
        }
    }
}

Task<Result<Done>> LitCells::light(WholeProgress whole) {
    runner_.as_whole = [this, whole = std::move(whole)](const Progress& now) {
        return whole ? whole(so_far(now)) : so_far(now);
    };
    GEODISK_CO_TRY(co_await choose_radii());
    std::vector<std::uint32_t> samples(samples_.size());
    std::iota(samples.begin(), samples.end(), 0u);
    const double bound = 1.01 * distance_bound(mesh_) / frame_.unit;
    const TakeLights add = [this](std::span<const gpu::LitRec> lights) { lit_.add(lights); };
    for (;;) {
        GEODISK_CO_TRY(co_await all_disks(samples, add));
        const double start = runner_.now();
        lit_.sort_from(0);
        std::vector<std::uint8_t> marks =
            open_cells(mesh_, lit_, radii_, closeness(), runner_.options.threads);
        samples.clear();
        for (std::uint32_t i = 0; i < marks.size(); ++i) {
            marks[i] = marks[i] != 0 && radii_[i] < bound ? 1 : 0;
            if (marks[i] != 0) {
                radii_[i] = std::min(bound, radii_[i] * kGrowth);
                samples.push_back(i);
            }
        }
        report_.seconds.sample += runner_.now() - start;
        if (samples.empty()) {
            co_return Done{};
        }
        lit_.drop(marks);
    }
}

} // namespace geodisk
