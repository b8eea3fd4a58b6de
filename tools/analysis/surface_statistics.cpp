#include "analysis/surface_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"

namespace geodisk::tools::analysis {
namespace {

using Point = ref::FacePoint<double>;

constexpr double kMaxCells = 0x1p24;
/// Sources that a thread takes at a time.
constexpr std::size_t kBatch = 64;
constexpr double kNone = std::numeric_limits<double>::infinity();
/// Bins of distances in each minimum distance.
constexpr std::size_t kBinsPerDistance = 20;

/// Uniform in [0, 1), the same on every machine.
double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Random places on the faces that the mask keeps, uniform by area: one in each of `count` parts of
/// equal area, face by face.
std::vector<Point> draw_places(const PreparedMesh& mesh, std::span<const std::uint8_t> face_mask,
                               std::uint32_t count, std::mt19937_64& random) {
    const auto& edges = mesh.half_edges();
    std::vector<double> up_to; // Areas of all faces so far.
    up_to.reserve(edges.size() / 3);
    double area = 0;
    std::ptrdiff_t last = 0; // Face that the mask keeps.
    for (std::size_t h = 0; h < edges.size(); h += 3) {
        if (face_mask.empty() || face_mask[h / 3] != 0) {
            area += edges[h].length * edges[h].apex_y / 2;
            last = static_cast<std::ptrdiff_t>(h / 3);
        }
        up_to.push_back(area);
    }
    std::vector<Point> places;
    places.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double at = area * ((i + uniform(random)) / count);
        const auto face = std::upper_bound(up_to.begin(), up_to.end(), at) - up_to.begin();
        double u = uniform(random), v = uniform(random);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        places.push_back({static_cast<std::uint32_t>(std::min(face, last)), u, v});
    }
    return places;
}

/// A sample and another one that it was found from.
struct Pair {
    std::uint32_t sample, other;
    double distance;
};

/// Findings of the disks of a batch of samples.
struct Found {
    std::vector<Pair> sample_distances; ///< Each pair both ways.
    /// Distances of places from samples, for each place and class: `place * classes + class`.
    std::vector<std::pair<std::size_t, double>> place_distances;
    std::vector<double> sample_pairs, place_pairs; ///< By bin.
};

/// Surface, samples and places, in units of about the distances looked for.
struct Layout {
    ref::Surface<double> surface;
    std::size_t samples;
    ref::Bins<double> bins;              ///< Samples, then places.
    std::vector<std::uint32_t> place_of; ///< Place of each sample, in the bins.

    Layout(const PreparedMesh& mesh, std::span<const SurfaceDisk> given,
           const std::vector<Point>& places, double spacing)
        : surface(mesh, ref::suitable_unit(mesh, spacing, kMaxCells)), samples(given.size()) {
        std::vector<Point> points;
        points.reserve(given.size() + places.size());
        for (const SurfaceDisk& sample : given) {
            points.push_back({sample.face, sample.weight1, sample.weight2});
        }
        points.insert(points.end(), places.begin(), places.end());
        bins = ref::Bins<double>(surface, points);
        place_of.resize(given.size());
        for (std::uint32_t place = 0; place < bins.order.size(); ++place) {
            if (bins.order[place] < samples) {
                place_of[bins.order[place]] = place;
            }
        }
    }
};

/// Computes the disks of samples, one after the other.
class Worker {
  public:
    Worker(const Layout& layout, std::span<const SurfaceDisk> samples,
           const ClassDistances& classes, double reach, double longest, std::size_t bins,
           std::vector<Found>& found)
        : layout_(layout), samples_(samples), classes_(classes), reach_(reach), longest_(longest),
          bin_count_(bins), found_(found),
          detector_(layout.surface, layout.bins, ref::double_tolerances(), 1),
          distances_(layout.bins.order.size(), kNone) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void operator()(std::size_t batch, std::size_t begin, std::size_t end) {
        Found& found = found_[batch];
        found.sample_pairs.assign(bin_count_, 0);
        found.place_pairs.assign(bin_count_, 0);
        for (std::size_t i = begin; i < end; ++i) {
            take(i, found);
        }
    }

  private:
    void take(std::size_t i, Found& found) {
        const double unit = layout_.surface.frame.unit;
        const SurfaceDisk& own = samples_[i];
        const std::uint32_t source = layout_.place_of[i];
        detector_.set_limit(std::min(reach_ * classes_.reach(own), longest_) / unit);
        detector_.run(
            layout_.bins.points[source], [&](std::uint32_t place) { return place != source; },
            [&](std::uint32_t place, double distance) {
                if (distances_[place] == kNone) {
                    near_.push_back(place);
                }
                distances_[place] = std::min(distances_[place], distance * unit);
            });
        for (const std::uint32_t place : near_) {
            const double distance = std::exchange(distances_[place], kNone);
            const std::uint32_t other = layout_.bins.order[place];
            const bool is_sample = other < layout_.samples;
            const double kept = is_sample ? classes_.of(own, samples_[other]) : 2 * own.radius;
            if (kept == 0) {
                continue; // Two classes that keep no distance.
            }
            const double relative = distance / kept;
            if (is_sample) {
                const auto self = static_cast<std::uint32_t>(i);
                found.sample_distances.push_back({self, other, relative});
                found.sample_distances.push_back({other, self, relative});
            } else {
                note_place(other - layout_.samples, own, distance, found);
            }
            const auto bin = static_cast<std::size_t>(relative * kBinsPerDistance);
            if (bin < bin_count_) {
                (is_sample ? found.sample_pairs : found.place_pairs)[bin] += 1;
            }
        }
        near_.clear();
    }

    void note_place(std::size_t place, const SurfaceDisk& own, double distance,
                    Found& found) const {
        if (classes_.count == 0) {
            found.place_distances.emplace_back(place, distance / (2 * own.radius));
        }
        for (std::size_t other = 0; other < classes_.count; ++other) {
            if (const double kept = classes_.of(own.kind - 1, other); kept > 0) {
                found.place_distances.emplace_back(place * classes_.count + other, distance / kept);
            }
        }
    }

    const Layout& layout_;
    std::span<const SurfaceDisk> samples_;
    const ClassDistances& classes_;
    double reach_, longest_;
    std::size_t bin_count_;
    std::vector<Found>& found_;
    ref::Detector<double, false> detector_;
    std::vector<double> distances_;   ///< By place in the bins, of the current source.
    std::vector<std::uint32_t> near_; ///< Places with one.
};

void note_nearest(SurfaceStatistics& result) {
    result.nearest = {1.0 / kBinsPerDistance, {}};
    result.nearest.counts.assign(static_cast<std::size_t>(result.reach) * kBinsPerDistance, 0);
    result.smallest = result.reach;
    double sum = 0;
    for (const auto& [sample, distance] : result.neighbors) {
        if (sample == Neighbor::kNone) {
            ++result.lonely;
            continue;
        }
        sum += distance;
        result.smallest = std::min(result.smallest, distance);
        result.nearest.counts[static_cast<std::size_t>(distance * kBinsPerDistance)] += 1;
    }
    const std::size_t others = result.neighbors.size() - result.lonely;
    result.mean_nearest = others > 0 ? sum / static_cast<double>(others) : 0;
}

/// `gaps` has, for each place and class, the distance to the nearest sample.
void note_gaps(const std::vector<double>& gaps, std::size_t classes, SurfaceStatistics& result) {
    std::vector<ClassRoom> rooms(std::max<std::size_t>(1, classes));
    std::uint64_t uncovered = 0;
    const std::size_t places = gaps.size() / rooms.size();
    const double part = 1 / static_cast<double>(places);
    for (auto place = gaps.begin(); place != gaps.end();) {
        bool has_room = false;
        for (ClassRoom& room : rooms) {
            const double gap = *place++;
            has_room |= gap >= 1;
            room.uncovered += gap >= 1 ? part : 0;
            room.largest_gap = std::max(room.largest_gap, std::min(gap, result.reach));
        }
        uncovered += has_room;
    }
    result.uncovered = static_cast<double>(uncovered) * part;
    result.largest_gap = std::ranges::max(rooms, {}, &ClassRoom::largest_gap).largest_gap;
    if (classes > 0) {
        result.rooms = std::move(rooms);
    }
}

void note_pairs(const std::vector<Found>& all, std::size_t samples, SurfaceStatistics& result) {
    const std::size_t bins = all.front().sample_pairs.size();
    std::vector<double> place_pairs(bins, 0);
    result.pair_correlation = {1.0 / kBinsPerDistance, std::vector<double>(bins, 0)};
    for (const Found& found : all) {
        for (std::size_t bin = 0; bin < bins; ++bin) {
            result.pair_correlation.counts[bin] += found.sample_pairs[bin];
            place_pairs[bin] += found.place_pairs[bin];
        }
    }
    // Another sample is any of the others, a place any of all.
    const double scale =
        static_cast<double>(result.probes) / std::max(1.0, static_cast<double>(samples) - 1);
    for (std::size_t bin = 0; bin < bins; ++bin) {
        double& g = result.pair_correlation.counts[bin];
        g = place_pairs[bin] > 0 ? g / place_pairs[bin] * scale : 0;
    }
}

} // namespace

SurfaceStatistics measure(const PreparedMesh& mesh, std::span<const std::uint8_t> face_mask,
                          std::span<const SurfaceDisk> samples, std::uint32_t probes,
                          std::uint64_t seed, const PartDone& tell, const ClassDistances& classes) {
    std::mt19937_64 random(seed);
    const std::vector<Point> places = draw_places(mesh, face_mask, probes, random);
    const auto [least, most] = std::minmax_element(
        samples.begin(), samples.end(),
        [](const SurfaceDisk& a, const SurfaceDisk& b) { return a.radius < b.radius; });
    const bool vary = least->radius < most->radius || classes.count > 0;
    SurfaceStatistics result;
    result.reach = vary ? SurfaceStatistics::kReachVarying : SurfaceStatistics::kReach;
    result.probes = probes;

    const Layout layout(mesh, samples, places, 2 * median_radius(samples));
    const std::size_t bins = vary ? 0 : static_cast<std::size_t>(result.reach) * kBinsPerDistance;
    std::vector<Found> found(batch_count(samples.size(), kBatch));
    const double longest = 2 * ref::longest_path(mesh);
    try {
        in_batches(
            samples.size(), kBatch,
            [&] { return Worker(layout, samples, classes, result.reach, longest, bins, found); },
            tell);
    } catch (const ref::EndlessDisk& error) {
        throw UserError(ExitCode::bad_input, error.what());
    }
    result.neighbors.resize(samples.size());
    std::vector<double> gaps(probes * std::max<std::size_t>(1, classes.count), kNone);
    for (const Found& batch : found) {
        for (const auto& [sample, other, distance] : batch.sample_distances) {
            Neighbor& nearest = result.neighbors[sample];
            if (distance < (nearest.sample == Neighbor::kNone ? result.reach : nearest.distance)) {
                nearest = {other, distance};
            }
        }
        for (const auto& [place, distance] : batch.place_distances) {
            gaps[place] = std::min(gaps[place], distance);
        }
    }
    note_nearest(result);
    note_gaps(gaps, classes.count, result);
    if (!vary) {
        note_pairs(found, samples.size(), result);
    }
    return result;
}

} // namespace geodisk::tools::analysis
