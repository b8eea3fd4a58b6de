#include "engine/cells/flat_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace geodisk {
namespace {

// More functions are told apart in smaller cells.
constexpr std::size_t kMaxPieces = 12, kMaxLights = 48;
// Distances are nearly linear if they are off by no more than this part of them.
constexpr double kExact = 0x1p-14;

} // namespace

void FlatPieces::gather(const CornerFunctions& functions, std::span<const std::uint32_t> lights,
                        double same) {
    pieces_.clear();
    for (const std::uint32_t light : lights) {
        const Piece piece{lit_.record(light).sample_index, functions.of(light)};
        const auto is_same_at = [&](const Piece& other, std::size_t k) {
            return std::abs(other.function.distances[k] - piece.function.distances[k]) <= same;
        };
        // A path through the next part of an edge, or past a vertex, goes on as the one beside it.
        const auto like = std::ranges::find_if(pieces_, [&](const Piece& other) {
            return other.sample == piece.sample && is_same_at(other, 0) && is_same_at(other, 1) &&
                   is_same_at(other, 2);
        });
        if (like == pieces_.end()) {
            pieces_.push_back(piece);
        } else {
            like->function.lit |= piece.function.lit;
            like->function.bend = std::max(like->function.bend, piece.function.bend);
        }
    }
}

/// Drops functions that another one is below, all over the cell. Returns false if one that is left
/// does not hold all over it.
bool FlatPieces::drop_beaten(double margin) {
    const auto is_beaten = [&](const Piece& piece) {
        return std::ranges::any_of(pieces_, [&](const Piece& other) {
            return piece.function.is_beaten_by(other.function, margin);
        });
    };
    samples_.clear();
    functions_.clear();
    band_ = 0;
    for (const Piece& piece : pieces_) {
        if (is_beaten(piece)) {
            continue;
        }
        if (piece.function.lit != CornerFunction::kAllLit || functions_.size() == kMaxPieces) {
            return false;
        }
        samples_.push_back(piece.sample);
        functions_.push_back(piece.function.values);
        band_ = std::max(band_, 2 * piece.function.bend);
    }
    return !functions_.empty() && std::isfinite(band_);
}

bool FlatPieces::find(const FacePart& part, const LitFaces::Target& target,
                      const NearLights::View& view, std::span<const std::uint32_t> lights,
                      Detail detail) {
    if (!view.is_lit || lights.size() > kMaxLights) {
        return false;
    }
    const CornerFunctions functions(lit_, part, target, lights);
    const bool is_known = detail == Detail::known;
    gather(functions, lights, is_known ? std::max(view.error, tie_) / 2 : tie_ / 4);
    const double farthest = view.distance + target.reach;
    const double rounding = functions.difference(farthest, (is_known ? 3 : 2) * view.error);
    const double ties = functions.difference(farthest, 3 * tie_);
    if (!drop_beaten(std::max(rounding, ties))) {
        return false;
    }
    const double least = view.distance - target.reach - functions.nearest_source();
    is_exact_ = band_ == 0 || band_ <= kExact * view.distance * 4 * least ||
                (is_known && band_ <= rounding);
    wide_band_ = band_ + ties;
    band_ += rounding;
    return true;
}

std::array<std::uint32_t, 3> FlatPieces::nearest() const {
    std::array<std::uint32_t, 3> found{};
    for (std::size_t k = 0; k < 3; ++k) {
        double least = std::numeric_limits<double>::infinity();
        for (const Piece& piece : pieces_) {
            least = std::min(least, piece.function.lit == CornerFunction::kAllLit
                                        ? piece.function.distances[k]
                                        : least);
        }
        found[k] = ~0u;
        for (const Piece& piece : pieces_) {
            if (piece.function.lit == CornerFunction::kAllLit &&
                piece.function.distances[k] <= least + tie_) {
                found[k] = std::min(found[k], piece.sample);
            }
        }
    }
    return found;
}

} // namespace geodisk
