#include "geometry/bisected_mesh.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/triangle_edges.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kWeightOne = 0x1p24; ///< Weights of samples are multiples of its inverse.
constexpr std::int64_t kWholeOne = std::int64_t{1} << 24;
constexpr std::int64_t kPartSteps = FacePart::kSteps;
constexpr std::int64_t kStep = kWholeOne / kPartSteps;

using Corners = std::array<std::uint32_t, 3>;
using Weights = std::array<std::uint16_t, 2>;

Weights middle_weights(const Weights& a, const Weights& b) {
    return {static_cast<std::uint16_t>((a[0] + b[0]) / 2),
            static_cast<std::uint16_t>((a[1] + b[1]) / 2)};
}

/// Weights of the second and third corner, as integers.
std::array<std::int64_t, 2> whole_weights(const Sample& sample) {
    return {static_cast<std::int64_t>(static_cast<double>(sample.weights[1]) * kWeightOne),
            static_cast<std::int64_t>(static_cast<double>(sample.weights[2]) * kWeightOne)};
}

/// A part of a face: its first corner in weights of samples, and its sides from there in steps.
struct PartFrame {
    explicit PartFrame(const FacePart& part)
        : x0(kStep * part.corners[0][0]), y0(kStep * part.corners[0][1]),
          ax(std::int64_t{part.corners[1][0]} - part.corners[0][0]),
          ay(std::int64_t{part.corners[1][1]} - part.corners[0][1]),
          bx(std::int64_t{part.corners[2][0]} - part.corners[0][0]),
          by(std::int64_t{part.corners[2][1]} - part.corners[0][1]) {}

    /// Returns a power of two.
    std::int64_t area() const { return ax * by - ay * bx; }
    /// Returns the weights of the second and third corner at a point, times kStep and area().
    std::array<std::int64_t, 2> weights(std::int64_t x, std::int64_t y) const {
        const std::int64_t px = x - x0, py = y - y0;
        return {px * by - py * bx, ax * py - ay * px};
    }
    bool holds(std::int64_t x, std::int64_t y) const {
        const auto [v, w] = weights(x, y);
        return v >= 0 && w >= 0 && v + w <= kStep * area();
    }

    std::int64_t x0, y0, ax, ay, bx, by;
};

Sample sample_with(std::uint32_t face, std::int64_t second, std::int64_t third) {
    const auto weight = [](std::int64_t steps) {
        return static_cast<float>(static_cast<double>(steps) / kWeightOne);
    };
    return {face, {weight(kWholeOne - second - third), weight(second), weight(third)}};
}

} // namespace

BisectedMesh::BisectedMesh(const MeshFile& mesh)
    : dimension_(mesh.dimension), positions_(mesh.positions), triangles_(mesh.triangles),
      parts_(mesh.triangle_count()), first_part_(mesh.triangle_count() + 1),
      old_vertices_(mesh.positions.size() / mesh.dimension) {
    for (std::uint32_t face = 0; face < parts_.size(); ++face) {
        parts_[face].face = face;
        first_part_[face] = face;
    }
    first_part_.back() = parts_.size();
}

double BisectedMesh::length2(std::uint32_t a, std::uint32_t b) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < dimension_; ++axis) {
        const double side = positions_[std::size_t{a} * dimension_ + axis] -
                            positions_[std::size_t{b} * dimension_ + axis];
        sum += side * side;
    }
    return sum;
}

std::size_t BisectedMesh::longest(const Corners& corners) const {
    const auto rank = [&](std::size_t k) {
        const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
        return std::tuple(length2(low, high), low, high);
    };
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        best = rank(k) > rank(best) ? k : best;
    }
    return best;
}

std::size_t BisectedMesh::longest(std::size_t triangle) const {
    return longest(
        {triangles_[3 * triangle], triangles_[3 * triangle + 1], triangles_[3 * triangle + 2]});
}

bool BisectedMesh::has_middle(std::size_t triangle, std::size_t edge) const {
    const auto& corners = parts_[triangle].corners;
    const Weights &a = corners[edge], &b = corners[(edge + 1) % 3];
    return (a[0] + b[0]) % 2 == 0 && (a[1] + b[1]) % 2 == 0;
}

std::optional<std::vector<std::uint32_t>> BisectedMesh::split(const std::vector<bool>& wanted,
                                                              std::size_t most) {
    const TriangleEdges edges(triangles_);
    std::vector<std::uint32_t> middles(edges.ends.size(), kNone);
    std::vector<std::uint32_t> marked, open; // Edges, and triangles whose longest edge is to split.
    for (std::uint32_t t = 0; t < wanted.size(); ++t) {
        if (wanted[t] && names_three(&triangles_[std::size_t{3} * t])) {
            open.push_back(t);
        }
    }
    std::size_t count = triangle_count();
    while (!open.empty()) {
        const std::uint32_t t = open.back();
        open.pop_back();
        const std::size_t k = longest(t);
        const std::uint32_t edge = edges.of_corner[std::size_t{3} * t + k];
        if (middles[edge] != kNone || !has_middle(t, k)) {
            continue;
        }
        middles[edge] = 0;
        marked.push_back(edge);
        for (const std::uint32_t corner : edges.on(edge)) {
            open.push_back(corner / 3);
            ++count;
        }
    }
    if (marked.empty() || count > most) {
        return std::nullopt;
    }
    std::ranges::sort(marked);
    for (const std::uint32_t edge : marked) {
        const auto [a, b] = edges.ends[edge];
        middles[edge] = static_cast<std::uint32_t>(positions_.size() / dimension_);
        ends_.push_back({a, b});
        for (std::size_t axis = 0; axis < dimension_; ++axis) {
            const double from = positions_[std::size_t{a} * dimension_ + axis];
            const double to = positions_[std::size_t{b} * dimension_ + axis];
            positions_.push_back(from / 2 + to / 2);
        }
    }
    std::vector<std::uint32_t> triangles, before;
    std::vector<FacePart> parts;
    triangles.reserve(3 * count);
    parts.reserve(count);
    before.reserve(count);
    /// A triangle with the middles of its edges, or kNone.
    struct Piece {
        Corners corners, middles;
        FacePart part;
    };
    std::vector<Piece> pieces;
    for (std::uint32_t t = 0; t < triangle_count(); ++t) {
        Piece first{{}, {}, parts_[t]};
        for (std::size_t k = 0; k < 3; ++k) {
            first.corners[k] = triangles_[std::size_t{3} * t + k];
            const std::uint32_t edge = edges.of_corner[std::size_t{3} * t + k];
            first.middles[k] = edge == kNone ? kNone : middles[edge];
        }
        pieces.assign(1, first);
        while (!pieces.empty()) {
            const Piece piece = pieces.back();
            pieces.pop_back();
            std::size_t k = longest(piece.corners);
            if (piece.middles[k] == kNone) {
                k = static_cast<std::size_t>(
                    std::ranges::find_if(piece.middles, [](auto m) { return m != kNone; }) -
                    piece.middles.begin());
            }
            if (k == 3) {
                triangles.insert(triangles.end(), piece.corners.begin(), piece.corners.end());
                parts.push_back(piece.part);
                before.push_back(t);
                continue;
            }
            const std::size_t next = (k + 1) % 3, apex = (k + 2) % 3;
            const auto& at = piece.part.corners;
            const Weights between = middle_weights(at[k], at[next]);
            Piece near = piece, far = piece;
            near.corners[next] = far.corners[k] = piece.middles[k];
            near.part.corners[next] = far.part.corners[k] = between;
            near.middles[k] = far.middles[k] = kNone;
            near.middles[next] = far.middles[apex] = kNone; // The edge between both.
            pieces.push_back(far);
            pieces.push_back(near);
        }
    }
    triangles_ = std::move(triangles);
    parts_ = std::move(parts);
    std::ranges::fill(first_part_, 0);
    for (const FacePart& part : parts_) {
        ++first_part_[part.face + 1];
    }
    for (std::size_t face = 1; face < first_part_.size(); ++face) {
        first_part_[face] += first_part_[face - 1];
    }
    return before;
}

std::vector<double> BisectedMesh::extended(std::span<const double> values, std::size_t size) const {
    std::vector<double> all(values.begin(), values.end());
    all.resize(old_vertices_ * size);
    for (const auto& [a, b] : ends_) {
        for (std::size_t k = 0; k < size; ++k) {
            all.push_back(all[a * size + k] / 2 + all[b * size + k] / 2);
        }
    }
    return all;
}

Sample BisectedMesh::whole(const Sample& sample) const {
    const FacePart& part = parts_[sample.face];
    if (part.is_whole()) {
        return {part.face, {sample.weights[0], sample.weights[1], sample.weights[2]}};
    }
    const PartFrame frame(part);
    const auto [v, w] = whole_weights(sample);
    // Weights on the face, times kPartSteps.
    const std::int64_t x = kPartSteps * frame.x0 + v * frame.ax + w * frame.bx,
                       y = kPartSteps * frame.y0 + v * frame.ay + w * frame.by;
    std::array<std::int64_t, 2> best{frame.x0, frame.y0}; // A corner.
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t second : {x / kPartSteps, x / kPartSteps + 1}) {
        for (const std::int64_t third : {y / kPartSteps, y / kPartSteps + 1}) {
            const std::int64_t off =
                std::abs(second * kPartSteps - x) + std::abs(third * kPartSteps - y);
            if (off < least && frame.holds(second, third)) {
                least = off;
                best = {second, third};
            }
        }
    }
    if (least == std::numeric_limits<std::int64_t>::max()) { // In the tip of a corner.
        const std::int64_t far = kWholeOne / 2;
        best = v > far   ? std::array{frame.x0 + kStep * frame.ax, frame.y0 + kStep * frame.ay}
               : w > far ? std::array{frame.x0 + kStep * frame.bx, frame.y0 + kStep * frame.by}
                         : best;
    }
    return sample_with(part.face, best[0], best[1]);
}

Sample BisectedMesh::part(const Sample& sample) const {
    const auto [x, y] = whole_weights(sample);
    for (std::size_t t = first_part_[sample.face]; t < first_part_[sample.face + 1]; ++t) {
        if (parts_[t].is_whole()) {
            return {static_cast<std::uint32_t>(t),
                    {sample.weights[0], sample.weights[1], sample.weights[2]}};
        }
        const PartFrame frame(parts_[t]);
        if (frame.holds(x, y)) {
            const auto [v, w] = frame.weights(x, y);
            return sample_with(static_cast<std::uint32_t>(t), v * kPartSteps / frame.area(),
                               w * kPartSteps / frame.area());
        }
    }
    return sample; // Weights that do not sum to 1 are of no part.
}

} // namespace geodisk::tools
