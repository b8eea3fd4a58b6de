#include "maximal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "kernels/detect.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "lib/rng.hpp"
#include "throw_darts.hpp"

namespace geodisk::ref {
namespace {

constexpr std::uint32_t kMaxSplits = 30;
constexpr std::uint32_t kEveryCell = 22; ///< Splits from which on each cell has a dart.
constexpr double kFirstGoal = 1.0 / 16;
constexpr double kRounding = 4.0 / (1 << 24); ///< Rounding of weights, as part of a face's reach.
constexpr std::uint64_t kSeed = 0x6d6178696d616c00;
/// Area of an equilateral triangle with the circumradius 1.
const double kEquilateral = 0.75 * std::sqrt(3.0);

/// Light of a disk on a face: from (x, y) in the frame of an edge, through a part of it or from
/// within.
struct Light {
    std::uint32_t edge;
    bool is_whole, keeps_out;
    double x, y, low, high, sigma, limit;
};

/// A triangle with corners on a grid of 2^-level of the weights.
struct Cell {
    std::uint32_t face, level;
    std::array<std::array<std::uint64_t, 2>, 3> corners;

    std::array<Cell, 4> parts() const {
        const auto between = [this](std::size_t a, std::size_t b) {
            return std::array{corners[a][0] + corners[b][0], corners[a][1] + corners[b][1]};
        };
        const auto p = between(0, 0), q = between(1, 1), r = between(2, 2), pq = between(0, 1),
                   qr = between(1, 2), rp = between(2, 0);
        return {{{face, level + 1, {p, pq, rp}},
                 {face, level + 1, {pq, q, qr}},
                 {face, level + 1, {rp, qr, r}},
                 {face, level + 1, {pq, qr, rp}}}};
    }
    FacePoint<double> corner(std::size_t k) const {
        return {face, std::ldexp(static_cast<double>(corners[k][0]), -static_cast<int>(level)),
                std::ldexp(static_cast<double>(corners[k][1]), -static_cast<int>(level))};
    }
    FacePoint<double> centroid() const {
        const double scale = std::ldexp(1.0, -static_cast<int>(level)) / 3;
        return {face, static_cast<double>(corners[0][0] + corners[1][0] + corners[2][0]) * scale,
                static_cast<double>(corners[0][1] + corners[1][1] + corners[2][1]) * scale};
    }
    std::uint32_t least(std::size_t axis) const {
        return static_cast<std::uint32_t>(
            std::min({corners[0][axis], corners[1][axis], corners[2][axis]}));
    }
    /// Returns false if the least coordinates are a corner, as of a whole face.
    bool is_turned() const {
        return std::ranges::none_of(corners, [this](const auto& corner) {
            return corner[0] == least(0) && corner[1] == least(1);
        });
    }
};

template <class Real>
class Filling {
  public:
    Filling(const PreparedMesh& mesh, const SampleParams& params, double error_bound)
        : params_(params), tolerances_(frame_of(mesh, params).tolerances(error_bound)),
          first_slack_(double{frame_of(mesh, params).tolerances().slack}), surface_(mesh, params),
          exact_(mesh, params), no_points_(surface_, {}), lights_(surface_.face_count()) {}

    MaximalSet run();

  private:
    void add_disk(FacePoint<Real> center);
    void add_avoided(const AvoidedPoint<Real>& avoided);
    struct Dart {
        std::uint64_t priority;
        FacePoint<double> at;
        auto key() const { return std::tuple(priority, at.face, at.weight1, at.weight2); }
    };
    /// Collects what is left of a cell.
    void split(const Cell& cell, double goal, std::vector<Cell>& left) const;
    void throw_into(const Cell& cell, std::uint32_t round, double mean,
                    std::vector<Dart>& darts) const;
    double share_of(const Cell& cell, double goal) const;
    double radius_at(FacePoint<double> point) const;
    double reach_of(std::uint32_t face) const;
    double spacing_of(const Cell& cell) const;
    double distance(const Light& light, FacePoint<double> point) const;
    double aside(const Light& light, FacePoint<double> point) const;
    bool is_free(FacePoint<double> point) const;
    std::vector<FacePoint<Real>> decided(const std::vector<Dart>& darts) const;

    const SampleParams& params_;
    Tolerances tolerances_;
    double first_slack_; ///< Lit intervals are widened by it.
    Surface<Real> surface_;
    Surface<double> exact_;
    Bins<Real> no_points_;
    std::vector<std::vector<Light>> lights_; ///< By face.
};

/// Takes what a disk lights, in a unit that is `scale` of the surface's.
template <class Real>
struct Recorder {
    std::vector<std::vector<Light>>& lights;
    const Detector<Real>& detector;
    bool keeps_out;
    double scale;

    void add(std::uint32_t h, bool is_whole, Real x, Real y, Real low, Real high,
             Real sigma) const {
        const auto of = [this](Real length) { return static_cast<double>(length) / scale; };
        lights[h / 3].push_back({h, is_whole, keeps_out, of(x), of(y), of(low), of(high), of(sigma),
                                 of(detector.limit_for_points())});
    }
    void face(std::uint32_t h, Real x, Real y, Real sigma) const {
        add(h, true, x, y, 0, 0, sigma);
    }
    void wedge(std::uint32_t h, Real x, Real y, Real low, Real high, Real sigma) const {
        add(h, false, x, -y, low, high, sigma);
    }
};

template <class Real>
void Filling<Real>::add_disk(FacePoint<Real> center) {
    Detector<Real> detector(surface_, no_points_, tolerances_, tolerances_.limit);
    detector.spread(center, Recorder<Real>{lights_, detector, false, 1});
}

template <class Real>
void Filling<Real>::add_avoided(const AvoidedPoint<Real>& avoided) {
    const Real scale = scale_of(avoided.radius);
    const Surface<Real> large = scaled(surface_, scale);
    const Bins<Real> none(large, {});
    const Real limit = avoided.radius * scale + (tolerances_.limit - Real{1});
    Detector<Real> detector(large, none, tolerances_, limit);
    detector.spread(avoided.center,
                    Recorder<Real>{lights_, detector, true, static_cast<double>(scale)});
}

template <class Real>
double Filling<Real>::radius_at(FacePoint<double> point) const {
    return exact_.is_adaptive() ? static_cast<double>(exact_.radius_at(point)) : 0;
}

template <class Real>
double Filling<Real>::reach_of(std::uint32_t face) const {
    const FacePoint<double> corners[3] = {{face, 0, 0}, {face, 1, 0}, {face, 0, 1}};
    const auto center = position_in(exact_, 3 * face, {face, 1.0 / 3, 1.0 / 3});
    double reach = 0;
    for (const auto& corner : corners) {
        const auto at = position_in(exact_, 3 * face, corner);
        reach = std::max(reach, std::sqrt((at.x - center.x) * (at.x - center.x) +
                                          (at.y - center.y) * (at.y - center.y)));
    }
    return reach;
}

template <class Real>
double Filling<Real>::spacing_of(const Cell& cell) const {
    return exact_.is_adaptive()
               ? 2 * std::min({radius_at(cell.corner(0)), radius_at(cell.corner(1)),
                               radius_at(cell.corner(2))})
               : 1;
}

template <class Real>
double Filling<Real>::distance(const Light& light, FacePoint<double> point) const {
    const auto at = position_in(exact_, light.edge, point);
    return std::sqrt((at.x - light.x) * (at.x - light.x) + (at.y - light.y) * (at.y - light.y)) +
           light.sigma;
}

/// Returns how far the point is from what the light sees.
template <class Real>
double Filling<Real>::aside(const Light& light, FacePoint<double> point) const {
    if (light.is_whole) {
        return 0;
    }
    const auto at = position_in(exact_, light.edge, point);
    const double x = at.x - light.x, y = at.y - light.y, depth = -light.y;
    const double low = light.low - first_slack_ - light.x,
                 high = light.high + first_slack_ - light.x;
    const double left = low * y - x * depth, right = x * depth - high * y;
    const double from_left = left > 0 ? left / std::sqrt(low * low + depth * depth) : 0;
    const double from_right = right > 0 ? right / std::sqrt(high * high + depth * depth) : 0;
    const double most = std::max(from_left, from_right);
    return left > 0 || right > 0 ? std::max(most, std::numeric_limits<double>::min()) : 0;
}

template <class Real>
bool Filling<Real>::is_free(FacePoint<double> point) const {
    return std::ranges::none_of(lights_[point.face], [&](const Light& light) {
        const double limit = light.keeps_out ? light.limit : light.limit + radius_at(point);
        return aside(light, point) == 0 && distance(light, point) < limit;
    });
}

template <class Real>
void Filling<Real>::split(const Cell& cell, double goal, std::vector<Cell>& left) const {
    const double whole = reach_of(cell.face);
    const double reach = std::ldexp(whole, -static_cast<int>(cell.level));
    const double margin = reach + kRounding * whole;
    const FacePoint<double> center = cell.centroid();
    double least = 0, most = 0;
    if (exact_.is_adaptive()) {
        std::tie(least, most) = std::minmax(
            {radius_at(cell.corner(0)), radius_at(cell.corner(1)), radius_at(cell.corner(2))});
    }
    bool is_open = true;
    for (const Light& light : lights_[cell.face]) {
        const double outside = aside(light, center), way = distance(light, center);
        if (outside == 0 && way + reach < light.limit + (light.keeps_out ? 0 : least)) {
            return;
        }
        is_open = is_open &&
                  (outside > margin || way - margin >= light.limit + (light.keeps_out ? 0 : most));
    }
    if (is_open || reach <= goal * spacing_of(cell) || cell.level == kMaxSplits) {
        left.push_back(cell);
        return;
    }
    for (const Cell& part : cell.parts()) {
        split(part, goal, left);
    }
}

template <class Real>
double Filling<Real>::share_of(const Cell& cell, double goal) const {
    const Edge<double>& edge = exact_.edges[std::size_t{3} * cell.face];
    const double area =
        std::ldexp(0.5 * edge.length * edge.apex_y, -2 * static_cast<int>(cell.level));
    const double reach = goal * spacing_of(cell);
    return area / (kEquilateral * reach * reach);
}

template <class Real>
void Filling<Real>::throw_into(const Cell& cell, std::uint32_t round, double mean,
                               std::vector<Dart>& darts) const {
    const std::uint32_t key = params_.face_keys.empty() ? cell.face : params_.face_keys[cell.face];
    const std::uint32_t kind = round << 8 | cell.level << 1 | (cell.is_turned() ? 1u : 0u);
    const auto own = philox(params_.seed ^ kSeed, {key, kind, cell.least(0), cell.least(1)});
    auto count = static_cast<std::uint32_t>(mean);
    count += own[0] * 0x1p-32 < mean - count ? 1u : 0u;
    count = cell.level >= kEveryCell ? std::max(count, 1u) : count;
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto random = philox(std::uint64_t{own[1]} << 32 | own[2], {own[3], k, kind, key});
        std::uint64_t a = random[2], b = random[3];
        if (a + b >= std::uint64_t{1} << 32) {
            a = 0xffffffff - a;
            b = 0xffffffff - b;
        }
        const auto weight = [&](std::size_t axis, std::uint64_t along) {
            const std::uint64_t first = std::uint64_t{cell.least(axis)} << 32;
            const std::uint64_t at = cell.is_turned() ? first + 0xffffffff - along : first + along;
            return static_cast<double>(at >> (8 + cell.level)) * 0x1p-24;
        };
        const FacePoint<double> at{cell.face, weight(0, a), weight(1, b)};
        if (is_free(at)) {
            darts.push_back({std::uint64_t{random[0]} << 32 | random[1], at});
        }
    }
}

template <class Real>
std::vector<FacePoint<Real>> Filling<Real>::decided(const std::vector<Dart>& darts) const {
    std::vector<FacePoint<Real>> points;
    points.reserve(darts.size());
    for (const Dart& dart : darts) {
        points.push_back(
            {dart.at.face, static_cast<Real>(dart.at.weight1), static_cast<Real>(dart.at.weight2)});
    }
    Pool<Real> pool;
    pool.bins = Bins<Real>(surface_, points);
    pool.places.resize(points.size());
    for (std::uint32_t place = 0; place < points.size(); ++place) {
        pool.places[pool.bins.order[place]] = place;
    }
    std::vector<FacePoint<Real>> accepted;
    for (const std::uint32_t rank : throw_darts(surface_, pool, tolerances_).ranks) {
        accepted.push_back(points[rank]);
    }
    return accepted;
}

template <class Real>
MaximalSet Filling<Real>::run() {
    std::vector<FacePoint<Real>> samples;
    for (const Sample& sample : params_.existing) {
        samples.push_back({sample.face, sample.weights[1], sample.weights[2]});
    }
    std::vector<AvoidedPoint<Real>> avoided;
    for (const auto& [center, radius] : params_.avoid) {
        avoided.push_back({{center.face, center.weights[1], center.weights[2]},
                           static_cast<Real>(static_cast<float>(radius / surface_.frame.unit))});
    }
    const Pool<Real> pool = draw_pool(surface_, params_);
    const RunResult first =
        throw_darts<Real>(surface_, pool, tolerances_, kMaxCandidates, samples, avoided);
    for (const std::uint32_t rank : first.ranks) {
        samples.push_back(pool.candidate(rank));
    }
    for (const AvoidedPoint<Real>& point : avoided) {
        add_avoided(point);
    }
    MaximalSet set;
    double goal = kFirstGoal;
    for (std::uint32_t round = 1, lit = 0;; ++round) {
        for (; lit < samples.size(); ++lit) {
            add_disk(samples[lit]);
        }
        std::vector<Cell> left;
        for (std::uint32_t face = 0; face < surface_.face_count(); ++face) {
            if (takes_samples(params_, face) && exact_.edges[std::size_t{3} * face].apex_y > 0) {
                split({face, 0, {{{0, 0}, {1, 0}, {0, 1}}}}, goal, left);
            }
        }
        set.is_complete = left.empty();
        double sum = 0;
        for (const Cell& cell : left) {
            sum += share_of(cell, goal);
        }
        const double most = std::clamp(16.0 * static_cast<double>(samples.size()), 0x1p16, 0x1p24);
        std::vector<Dart> darts;
        for (const Cell& cell : left) {
            throw_into(cell, round, share_of(cell, goal) * std::min(1.0, most / sum), darts);
        }
        std::ranges::sort(darts, {}, &Dart::key);
        const std::vector<FacePoint<Real>> more = decided(darts);
        set.rounds += darts.empty() ? 0u : 1u;
        const bool are_smallest =
            std::ranges::all_of(left, [](const Cell& cell) { return cell.level == kMaxSplits; });
        if (left.empty() || (more.empty() && are_smallest)) {
            break;
        }
        samples.insert(samples.end(), more.begin(), more.end());
        goal = std::max(goal / 4, 0x1p-40);
    }
    for (const FacePoint<Real>& point : samples) {
        set.samples.push_back(
            {point.face, static_cast<double>(point.weight1), static_cast<double>(point.weight2)});
    }
    return set;
}

} // namespace

template <class Real>
MaximalSet maximal_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    return Filling<Real>(mesh, params, error_bound).run();
}

template MaximalSet maximal_set<float>(const PreparedMesh&, const SampleParams&, double);
template MaximalSet maximal_set<double>(const PreparedMesh&, const SampleParams&, double);

} // namespace geodisk::ref
