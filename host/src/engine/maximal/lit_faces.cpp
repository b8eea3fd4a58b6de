#include "engine/maximal/lit_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geodisk {
namespace {

// Steps of 2^-24 by which the weights of a point may be rounded, twice over.
constexpr double kGrid = 4 * 0x1p-24;
// Longest edge of a sliver, in parts of its height.
constexpr double kSliver = 16;

/// Offsets of a target from the source of a light, in the frame of the light's half-edge.
struct Offset {
    double x, y, distance;
};

Offset offset_of(const gpu::LitRec& record, const LitFaces::Target& target) {
    const LitFaces::Target::Place& at = target.at[(record.place >> 1) % 3];
    const double x = at.x - double{record.x}, y = at.y - double{record.y};
    return {x, y, std::sqrt(x * x + y * y) + double{record.sigma}};
}

/// Returns how far the target is outside the borders of the lit part; 0 within.
double aside(const gpu::LitRec& record, const Offset& offset, double slack) {
    if ((record.place & 1) != 0) {
        return 0;
    }
    const double x = record.x, y = -double{record.y};
    const double low = double{record.low} - slack - x;
    const double high = double{record.high} + slack - x;
    const double at = offset.x * y;
    const double left = low * offset.y - at;
    const double right = at - high * offset.y;
    if (left <= 0 && right <= 0) {
        return 0;
    }
    const double to_left = left > 0 ? left / std::sqrt(low * low + y * y) : 0;
    const double to_right = right > 0 ? right / std::sqrt(high * high + y * y) : 0;
    return std::max({to_left, to_right, std::numeric_limits<double>::min()});
}

} // namespace

LitFaces::LitFaces(const PreparedMesh& mesh, const SampleParams& params, const JobFrame& frame,
                   double slack)
    : mesh_(mesh), radii_(params.radii), unit_(frame.unit), slack_(slack),
      reaches_(mesh.face_count()), starts_(std::size_t{mesh.face_count()} + 1, 0) {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
        const double x = (edge.length + edge.apex_x) / 3, y = edge.apex_y / 3;
        const auto square = [&](double corner_x, double corner_y) {
            const double dx = x - corner_x, dy = y - corner_y;
            return dx * dx + dy * dy;
        };
        reaches_[face] = std::sqrt(std::max({square(0, 0), square(edge.length, 0),
                                             square(edge.apex_x, edge.apex_y)})) /
                         unit_;
    }
}

void LitFaces::add(std::span<const gpu::LitRec> records) {
    records_.insert(records_.end(), records.begin(), records.end());
}

void LitFaces::drop(std::span<const std::uint8_t> marks) {
    std::erase_if(records_,
                  [&](const gpu::LitRec& record) { return marks[record.sample_index] != 0; });
}

void LitFaces::sort_from(std::size_t first) {
    const auto face_of = [this](std::size_t light) { return records_[light].place / 6; };
    std::ranges::fill(starts_, 0);
    for (std::size_t light = first; light < records_.size(); ++light) {
        ++starts_[face_of(light) + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    sorted_.resize(records_.size() - first);
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t light = first; light < records_.size(); ++light) {
        sorted_[next[face_of(light)]++] = static_cast<std::uint32_t>(light);
    }
}

std::span<const std::uint32_t> LitFaces::lights_of(std::uint32_t face) const {
    return std::span(sorted_).subspan(starts_[face], starts_[face + 1] - starts_[face]);
}

double LitFaces::area(std::uint32_t face) const {
    const HalfEdge& edge = mesh_.half_edges()[std::size_t{3} * face];
    return 0.5 * (edge.length / unit_) * (edge.apex_y / unit_);
}

double LitFaces::radius_at(std::uint32_t face, FaceWeights weights) const {
    const float* const g = &radii_->factors()[std::size_t{3} * face];
    const double first = 1 - weights.second - weights.third;
    return 0.5 *
           (first * double{g[0]} + weights.second * double{g[1]} + weights.third * double{g[2]});
}

void LitFaces::place(std::uint32_t face, FaceWeights weights, Target& target) const {
    const double all[3] = {1 - weights.second - weights.third, weights.second, weights.third};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfEdge& edge = mesh_.half_edges()[std::size_t{3} * face + k];
        const double end = all[(k + 1) % 3], apex = all[(k + 2) % 3];
        target.at[k] = {(end * edge.length + apex * edge.apex_x) / unit_,
                        apex * edge.apex_y / unit_};
    }
}

LitFaces::Target LitFaces::target(const GapCell& cell) const {
    Target target{};
    place(cell.face, cell.centroid(), target);
    target.reach = reaches_[cell.face] * cell.step();
    target.margin = target.reach + kGrid * reaches_[cell.face];
    if (radii_ != nullptr) {
        const auto corners = cell.corners();
        const double radii[3] = {radius_at(cell.face, corners[0]), radius_at(cell.face, corners[1]),
                                 radius_at(cell.face, corners[2])};
        target.min_radius = std::min({radii[0], radii[1], radii[2]});
        target.largest_radius = std::max({radii[0], radii[1], radii[2]});
    }
    return target;
}

LitFaces::Target LitFaces::target(std::uint32_t face, FaceWeights weights) const {
    Target target{};
    place(face, weights, target);
    if (radii_ != nullptr) {
        target.min_radius = target.largest_radius = radius_at(face, weights);
    }
    return target;
}

LitFaces::LongestEdge LitFaces::longest_edge(const FacePart& part) const {
    Target at[3]{};
    for (std::size_t k = 0; k < 3; ++k) {
        place(part.face, part.corners[k], at[k]);
    }
    LongestEdge longest{0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const Target::Place &from = at[(k + 1) % 3].at[0], &to = at[(k + 2) % 3].at[0];
        const double x = to.x - from.x, y = to.y - from.y;
        if (x * x + y * y > longest.square) {
            longest = {k, x * x + y * y};
        }
    }
    return longest;
}

bool LitFaces::is_sliver(std::uint32_t face) const {
    const GapCell whole{face, 0, 0, 0, false};
    return longest_edge(whole.part()).square > kSliver * 2 * area(face);
}

std::array<FacePart, 2> LitFaces::halves(const FacePart& part) const {
    const std::size_t k = longest_edge(part).across;
    const FaceWeights &a = part.corners[k], &b = part.corners[(k + 1) % 3],
                      &c = part.corners[(k + 2) % 3];
    const FaceWeights middle{(b.second + c.second) / 2, (b.third + c.third) / 2};
    return {FacePart{part.face, {a, b, middle}}, FacePart{part.face, {a, middle, c}}};
}

LitFaces::Target LitFaces::target(const FacePart& part) const {
    const auto& [a, b, c] = part.corners;
    Target target{};
    place(part.face, {(a.second + b.second + c.second) / 3, (a.third + b.third + c.third) / 3},
          target);
    double square = 0;
    for (const FaceWeights& corner : part.corners) {
        Target at{};
        place(part.face, corner, at);
        const double x = at.at[0].x - target.at[0].x, y = at.at[0].y - target.at[0].y;
        square = std::max(square, x * x + y * y);
    }
    target.reach = std::sqrt(square);
    target.margin = target.reach + kGrid * reaches_[part.face];
    return target;
}

double LitFaces::limit_of(const gpu::LitRec& record, double radius) const {
    return record.limit < 0 ? -double{record.limit} : double{record.limit} + radius;
}

LitFaces::Sight LitFaces::sight(std::uint32_t light, const Target& target) const {
    const gpu::LitRec& record = records_[light];
    const Offset offset = offset_of(record, target);
    return {offset.distance, aside(record, offset, slack_)};
}

Cover LitFaces::cover(std::uint32_t light, const Target& target) const {
    const gpu::LitRec& record = records_[light];
    const Offset offset = offset_of(record, target);
    if (offset.distance - target.margin >= limit_of(record, target.largest_radius)) {
        return Cover::none;
    }
    const double outside = aside(record, offset, slack_);
    if (outside > target.margin) {
        return Cover::none;
    }
    const bool is_near = offset.distance + target.reach < limit_of(record, target.min_radius);
    return outside == 0 && is_near ? Cover::all : Cover::some;
}

double LitFaces::excess(std::uint32_t light, const Target& target) const {
    const auto [distance, outside] = sight(light, target);
    return outside > 0 ? std::numeric_limits<double>::infinity()
                       : distance + target.reach - limit_of(records_[light], target.min_radius);
}

} // namespace geodisk
