#include <geodisk/farthest.hpp>
#include <geodisk/nearest.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <string>
#include <utility>

#include "engine/cells/nearest_impl.hpp"
#include "engine/domain/device_mesh.hpp"
#include "engine/domain/placed_surface.hpp"
#include "engine/neighbours/check_query.hpp"
#include "engine/neighbours/order_samples.hpp"
#include "engine/neighbours/search_within.hpp"
#include "mesh/components.hpp"
#include "mesh/edge_paths.hpp"
#include "mesh/extent.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Each search computes disks of so many more samples, as a part of those chosen. More at once would
// be larger than they need be, since the distance falls.
constexpr double kPartAhead = 0.5;
// Disks are larger by this, since rounding may leave out what is close to their rim.
constexpr double kMargin = 1.001;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Chooses samples one after the other. A disk about each one chosen lowers the distances of the
/// others. It only needs to reach as far as the largest of these, and where no sample chosen before
/// is nearer. So disks of samples that are far now will do when their turn comes, and are computed
/// many at a time.
class FarthestSearch {
  public:
    FarthestSearch(Runner::Impl& runner, const PreparedMesh& mesh, std::span<const Sample> samples,
                   const FarthestParams& params)
        : runner_(runner), mesh_(mesh), samples_(samples),
          existing_(samples.first(params.existing)), start_(params.start),
          count_(chosen_of(samples, params)), distances_(samples.size(), kInfinite),
          states_(samples.size(), State::open), disks_(samples.size()), paths_(mesh),
          bounded_(samples.size(), kInfinite) {}

    Task<Result<FarthestOrder>> go();

  private:
    enum class State : std::uint8_t { open, has_disk, chosen };
    struct Near {
        std::uint32_t sample;
        float distance;
    };
    /// A sample at the distance that it had when this was noted.
    struct Candidate {
        float distance;
        std::uint32_t sample;
        /// Orders candidates by how soon they are chosen, the last one first.
        friend bool operator<(const Candidate& a, const Candidate& b) {
            return std::pair(a.distance, b.sample) < std::pair(b.distance, a.sample);
        }
    };

    /// Chooses the existing samples, and puts all in the queue.
    Task<Result<Done>> begin();
    /// Returns the sample to choose next, which stays in the queue.
    std::uint32_t farthest();
    /// Computes the disk of this sample, the farthest one, and those of others far away.
    Task<Result<Done>> search(std::uint32_t first);
    std::vector<std::uint32_t> first_of_parts() const;
    std::vector<std::uint32_t> farthest_open() const;
    /// Returns how far each vertex is at most from a sample chosen.
    const std::vector<double>& bounds();
    void keep(const std::vector<std::uint32_t>& sources, const Neighbours& found);
    void choose(std::uint32_t sample);
    /// Returns the progress of all, from that of the disks at hand.
    Progress so_far(const Progress& now) const;

    Runner::Impl& runner_;
    const PreparedMesh& mesh_;
    std::span<const Sample> samples_;
    std::span<const Sample> existing_;
    std::uint32_t start_;
    std::uint32_t count_;
    std::vector<float> distances_; ///< Distance from each sample to those chosen.
    std::vector<State> states_;
    std::vector<std::vector<Near>> disks_; ///< Samples that come nearer when this one is chosen.
    std::priority_queue<Candidate> queue_; ///< With those of all distances before.
    EdgePaths paths_;
    std::vector<float> bounded_; ///< Distances of the samples where paths have begun.
    FarthestOrder order_;
    std::uint32_t searched_ = 0; ///< Disks.
};

Task<Result<Done>> FarthestSearch::begin() {
    if (!existing_.empty()) {
        const WholeProgress whole = [this](const Progress& now) {
            return so_far({0, 0, 0, now.disks, now.windows});
        };
        const auto nearest = co_await NearestSamples::Impl::find(runner_, mesh_, existing_,
                                                                 CellParams{}.max_records, whole);
        GEODISK_CO_TRY(nearest);
        const auto found = nearest->of(samples_);
        GEODISK_CO_TRY(found);
        std::ranges::transform(*found, distances_.begin(), &NearestSample::distance);
        std::ranges::fill(std::span(states_).first(existing_.size()), State::chosen);
        order_.error = nearest->error();
        order_.report.add(nearest->report());
    }
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
        if (i < existing_.size()) {
            order_.indices.push_back(i);
            order_.distances.push_back(kInfinite);
        }
        queue_.push({distances_[i], i});
    }
    co_return Done{};
}

std::uint32_t FarthestSearch::farthest() {
    for (;;) {
        const auto [distance, sample] = queue_.top();
        if (states_[sample] != State::chosen && distance == distances_[sample]) {
            return sample;
        }
        queue_.pop();
    }
}

std::vector<std::uint32_t> FarthestSearch::first_of_parts() const {
    Components components(mesh_);
    std::set<std::uint32_t> parts;
    std::vector<std::uint32_t> first;
    const auto add = [&](std::uint32_t i) {
        const bool is_far = states_[i] == State::open && distances_[i] == kInfinite;
        if (is_far && parts.insert(components.of(samples_[i])).second) {
            first.push_back(i);
        }
    };
    add(start_);
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
        add(i);
    }
    return first;
}

std::vector<std::uint32_t> FarthestSearch::farthest_open() const {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
        if (states_[i] == State::open && distances_[i] > 0) {
            open.push_back(i);
        }
    }
    const auto ahead = static_cast<std::size_t>(
        std::ceil(kPartAhead * static_cast<double>(order_.indices.size())));
    const std::size_t left = count_ - order_.indices.size();
    const std::size_t most = std::min({ahead, left, open.size()});
    const auto end = open.begin() + static_cast<std::ptrdiff_t>(most);
    std::ranges::nth_element(open, end, [this](std::uint32_t a, std::uint32_t b) {
        return Candidate{distances_[b], b} < Candidate{distances_[a], a};
    });
    open.erase(end, open.end());
    return open;
}

const std::vector<double>& FarthestSearch::bounds() {
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
        const float distance = states_[i] == State::chosen ? 0 : distances_[i];
        if (distance < bounded_[i]) {
            bounded_[i] = distance;
            paths_.begin_at(samples_[i], distance + 2 * order_.error);
        }
    }
    return paths_.lengths();
}

Task<Result<Done>> FarthestSearch::search(std::uint32_t first) {
    const float distance = distances_[first];
    const bool is_infinite = distance == kInfinite;
    const std::vector<std::uint32_t> sources = is_infinite ? first_of_parts() : farthest_open();
    std::vector<Sample> points;
    points.reserve(sources.size());
    for (const std::uint32_t source : sources) {
        points.push_back(samples_[source]);
    }
    NeighbourQuery query;
    query.sources = points;
    query.kind = NeighbourKind::points;
    query.points = samples_;
    query.within = is_infinite ? distance_bound(mesh_)
                               : std::max(kMargin * double{distance}, shortest_distance(mesh_));
    const WholeProgress whole = [this](const Progress& now) { return so_far(now); };
    const std::span<const double> ends = is_infinite ? std::span<const double>() : bounds();
    const auto found = co_await search_within(runner_, mesh_, query, whole, ends);
    GEODISK_CO_TRY(found);
    order_.error = std::max(order_.error, found->error);
    order_.report.add(found->report);
    ++order_.searches;
    searched_ += static_cast<std::uint32_t>(sources.size());
    keep(sources, *found);
    co_return Done{};
}

void FarthestSearch::keep(const std::vector<std::uint32_t>& sources, const Neighbours& found) {
    for (std::size_t row = 0; row < sources.size(); ++row) {
        states_[sources[row]] = State::has_disk;
        std::vector<Near>& disk = disks_[sources[row]];
        for (std::size_t at = found.offsets[row]; at < found.offsets[row + 1]; ++at) {
            const Near near{found.indices[at], found.distances[at]};
            if (near.distance < distances_[near.sample]) {
                disk.push_back(near);
            }
        }
    }
}

void FarthestSearch::choose(std::uint32_t sample) {
    order_.indices.push_back(sample);
    order_.distances.push_back(distances_[sample]);
    states_[sample] = State::chosen;
    for (const Near& near : std::exchange(disks_[sample], {})) {
        if (states_[near.sample] != State::chosen && near.distance < distances_[near.sample]) {
            distances_[near.sample] = near.distance;
            queue_.push({near.distance, near.sample});
        }
    }
}

Progress FarthestSearch::so_far(const Progress& now) const {
    const std::uint32_t disks = std::min(searched_ + now.decided, count_);
    const auto chosen = static_cast<std::uint32_t>(order_.indices.size());
    return {std::max(disks, chosen), count_, chosen, order_.report.disks + now.disks,
            order_.report.windows + now.windows};
}

Task<Result<FarthestOrder>> FarthestSearch::go() {
    GEODISK_CO_TRY(co_await begin());
    while (order_.indices.size() < count_) {
        const std::uint32_t next = order_.indices.empty() ? start_ : farthest();
        // At the place of one chosen, it brings no other nearer.
        if (states_[next] == State::open && distances_[next] > 0) {
            GEODISK_CO_TRY(co_await search(next));
        }
        choose(next);
    }
    if (count_ < samples_.size()) {
        order_.cover = distances_[farthest()];
    }
    co_return std::move(order_);
}

Result<Done> check_order(const PreparedMesh& mesh, std::span<const Sample> samples,
                         const FarthestParams& params) {
    if (samples.empty()) {
        return invalid("there is no sample to put in order");
    }
    if (params.count > samples.size()) {
        return invalid("there are " + std::to_string(samples.size()) + " samples, fewer than " +
                       std::to_string(params.count) + " to choose");
    }
    if (params.start >= samples.size()) {
        return invalid("start is " + std::to_string(params.start) + ", but there are " +
                       std::to_string(samples.size()) + " samples, counted from 0");
    }
    if (params.start != 0 && params.existing != 0) {
        return invalid("start and existing exclude each other: existing samples come first");
    }
    if (params.existing > samples.size() || (params.count != 0 && params.count < params.existing)) {
        return invalid(std::to_string(params.existing) + " samples are existing ones, more than " +
                       std::to_string(params.count == 0 ? samples.size() : params.count) +
                       " to choose");
    }
    return check_points(mesh, "sample", samples);
}

} // namespace

Result<FarthestOrder> farthest_order(Runner& runner, const PreparedMesh& mesh,
                                     std::span<const Sample> samples, const FarthestParams& params,
                                     const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<FarthestOrder> {
        GEODISK_TRY(check_farthest_order(runner, mesh));
        Runner::Impl& impl = Runner::Impl::of(runner);
        return impl.complete(order_samples(impl, mesh, samples, params), chosen_of(samples, params),
                             progress);
    });
}

Task<Result<FarthestOrder>> order_samples(Runner::Impl& runner, const PreparedMesh& mesh,
                                          std::span<const Sample> samples, FarthestParams params) {
    GEODISK_CO_TRY(check_order(mesh, samples, params));
    FarthestSearch search(runner, mesh, samples, params);
    co_return co_await search.go();
}

Result<Done> check_farthest_order(Runner& runner, const PreparedMesh& mesh) noexcept {
    return guarded([&]() -> Result<Done> {
        const PlacedSurface whole{&mesh, {}, {}, {}, 0, 0, 0};
        const std::uint64_t bytes = half_edge_bytes({&whole, 1}) + length_bytes({&whole, 1});
        const DeviceReport& device = Runner::Impl::of(runner).engine().report;
        if (bytes <= device.limits.max_storage_buffer_range) {
            return Done{};
        }
        return Error{Status::job_too_large,
                     "the farthest order takes all " + std::to_string(mesh.face_count()) +
                         " faces at once, which are " + std::to_string(bytes) + " bytes, but " +
                         device.name + " binds at most " +
                         std::to_string(device.limits.max_storage_buffer_range) +
                         "; take another order, or give a mesh of fewer faces"};
    });
}

} // namespace geodisk
