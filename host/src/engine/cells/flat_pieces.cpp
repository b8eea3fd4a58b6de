#include "engine/cells/flat_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace geodisk {
namespace {

// More functions are told apart in smaller cells.
constexpr std::size_t kMostPieces = 12;
constexpr std::uint32_t kAllLit = 7;
// Distances are nearly linear if they are off by no more than this part of them.
constexpr double kExact = 0x1p-14;

} // namespace

void FlatPieces::gather(const GapCell& cell, const LitFaces::Target& target,
                        std::span<const std::uint32_t> lights) {
    std::array<LitFaces::Target, 3> corners;
    std::array<double, 3> squares;
    const auto weights = cell.corners();
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = lit_.target(cell.face, weights[k]);
        const double x = corners[k].at[0].x - target.at[0].x;
        const double y = corners[k].at[0].y - target.at[0].y;
        squares[k] = x * x + y * y;
    }
    nearest_source_ = std::numeric_limits<double>::infinity();
    for (const std::uint32_t light : lights) {
        nearest_source_ = std::min(nearest_source_, double{lit_.record(light).sigma});
    }
    pieces_.clear();
    for (const std::uint32_t light : lights) {
        const gpu::LitRec& record = lit_.record(light);
        Piece piece{record.sample_index, {}, {}, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [distance, outside] = lit_.sight(light, corners[k]);
            const double from = distance - nearest_source_;
            piece.distances[k] = distance;
            piece.values[k] = from * from - squares[k];
            piece.lit |= (outside == 0 ? 1u : 0u) << k;
        }
        const double farther = double{record.sigma} - nearest_source_;
        if (farther > 0) {
            // The second derivative of a distance is at most 1 over that distance.
            const double straight =
                lit_.sight(light, target).distance - double{record.sigma} - target.reach;
            piece.bend = straight > 0 ? farther / straight * target.reach * target.reach
                                      : std::numeric_limits<double>::infinity();
        }
        // A path through the next part of an edge, or past a vertex, goes on as the one beside it.
        const auto same = std::ranges::find_if(pieces_, [&](const Piece& other) {
            return other.sample == piece.sample &&
                   std::abs(other.distances[0] - piece.distances[0]) <= tie_ / 4 &&
                   std::abs(other.distances[1] - piece.distances[1]) <= tie_ / 4 &&
                   std::abs(other.distances[2] - piece.distances[2]) <= tie_ / 4;
        });
        if (same == pieces_.end()) {
            pieces_.push_back(piece);
        } else {
            same->lit |= piece.lit;
            same->bend = std::max(same->bend, piece.bend);
        }
    }
}

/// Drops functions that another one is below, all over the cell. Returns false if one that is left
/// does not hold all over it.
bool FlatPieces::drop_beaten(double margin) {
    const auto is_beaten = [&](const Piece& piece) {
        return std::ranges::any_of(pieces_, [&](const Piece& other) {
            const double beyond = piece.bend + other.bend + margin;
            return other.lit == kAllLit && piece.values[0] > other.values[0] + beyond &&
                   piece.values[1] > other.values[1] + beyond &&
                   piece.values[2] > other.values[2] + beyond;
        });
    };
    samples_.clear();
    functions_.clear();
    band_ = 0;
    for (const Piece& piece : pieces_) {
        if (is_beaten(piece)) {
            continue;
        }
        if (piece.lit != kAllLit || functions_.size() == kMostPieces) {
            return false;
        }
        samples_.push_back(piece.sample);
        functions_.push_back(piece.values);
        band_ = std::max(band_, 2 * piece.bend);
    }
    return !functions_.empty() && std::isfinite(band_);
}

bool FlatPieces::find(const GapCell& cell, const LitFaces::Target& target,
                      const NearLights::View& view, std::span<const std::uint32_t> lights) {
    if (!view.is_lit) {
        return false;
    }
    gather(cell, target, lights);
    const double rounding = 2 * error_, ties = 3 * tie_;
    const double scale = 2 * (view.distance + target.reach + rounding + ties - nearest_source_);
    if (!drop_beaten(scale * std::max(rounding, ties))) {
        return false;
    }
    const double least = view.distance - target.reach - nearest_source_;
    is_exact_ = band_ == 0 || band_ <= kExact * view.distance * 4 * least;
    wide_band_ = band_ + scale * ties;
    band_ += scale * rounding;
    return true;
}

std::array<std::uint32_t, 3> FlatPieces::nearest() const {
    std::array<std::uint32_t, 3> found{};
    for (std::size_t k = 0; k < 3; ++k) {
        double least = std::numeric_limits<double>::infinity();
        for (const Piece& piece : pieces_) {
            least = std::min(least, piece.lit == kAllLit ? piece.distances[k] : least);
        }
        found[k] = ~0u;
        for (const Piece& piece : pieces_) {
            if (piece.lit == kAllLit && piece.distances[k] <= least + tie_) {
                found[k] = std::min(found[k], piece.sample);
            }
        }
    }
    return found;
}

} // namespace geodisk
