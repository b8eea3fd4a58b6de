#include "engine/cells/cell_splitter.hpp"

#include <algorithm>
#include <utility>

#include <geodisk/detail/vertex_sets.hpp>

namespace geodisk {
namespace {

// Cells of a face that are split, per light. Far fewer are needed but where samples are equally
// near along lines that no linear function tells.
constexpr std::uint64_t kSplitsPerLight = 1u << 14;
// A part of a sliver that reaches no farther is not cut: in units of the frame, and in errors of
// distances.
constexpr double kSmallestHalf = 0x1p-11;
constexpr double kErrorsPerHalf = 8;
// Shares are summed when there are more.
constexpr std::size_t kManyShares = 1u << 16;

void add_pair(FoundCells& found, std::uint32_t a, std::uint32_t b) {
    if (a != b) {
        found.pairs.push_back({std::min(a, b), std::max(a, b)});
    }
}

/// Sorts three samples. Returns true if they then turn the other way.
bool sort_turning(std::array<std::uint32_t, 3>& samples) {
    bool turns = false;
    for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(1u, 2u), std::pair(0u, 1u)}) {
        if (samples[a] > samples[b]) {
            std::swap(samples[a], samples[b]);
            turns = !turns;
        }
    }
    return turns;
}

} // namespace

void CellSplitter::split(std::uint32_t face, FoundCells& found) {
    found_ = &found;
    const NearLights::Range lights = near_.begin(face);
    left_ = kSplitsPerLight * (lights.end + 1);
    meets_ = false;
    knotted_.clear();
    meetings_.clear();
    const GapCell whole{face, 0, 0, 0, false};
    const bool in_halves = !lights.empty() && lit_.is_sliver(face);
    if (in_halves) {
        const std::uint32_t first = near_.sample_of(near_.at(lights).front());
        split_sliver(whole.part(), lit_.area(face), lights, first);
        near_.pop_to(lights);
    }
    if (!in_halves || meets_) {
        split(whole, {lights, true, in_halves});
    }
    tie_knots();
    if (found.shares.size() > kManyShares) {
        merge(found);
    }
}

void CellSplitter::split(const GapCell& cell, const State& around) {
    const FacePart part = cell.part();
    const LitFaces::Target target = lit_.target(cell);
    const NearLights::View view = near_.look(part, target, around.lights);
    const auto lights = near_.at(view.lights);
    const double area = around.has_area ? 0 : lit_.area(cell.face) * cell.step() * cell.step();
    if (lights.empty()) {
        found_->unreached += area;
        return;
    }
    const std::uint32_t nearest = view.is_lit ? view.nearest : near_.sample_of(lights.front());
    if (near_.is_single(view.lights)) {
        give(nearest, area, 0);
        return;
    }
    if (!view.is_lit && !around.is_lit) {
        give(nearest, area, area); // A crack that rounding leaves between paths.
        return;
    }
    const bool is_flat = flat_.find(part, target, view, lights, FlatPieces::Detail::computed);
    const bool is_last = cell.level == grid_.level() || left_ == 0;
    const bool shares = is_flat && (flat_.is_exact() || is_last);
    const bool has_area = around.has_area || shares || is_last;
    if (!around.has_area && shares) {
        share_out(area);
    } else if (!around.has_area && is_last) {
        give(nearest, area, area);
    }
    const std::uint32_t near = has_dual_ ? count_near(is_flat, lights) : 0;
    if (has_area && near < 3) {
        if (near == 2 && is_flat) {
            note_pair();
        }
    } else if (!is_last) {
        --left_;
        for (const GapCell& child : cell.children()) {
            split(child, {view.lights, view.is_lit, has_area});
            near_.pop_to(view.lights);
        }
    } else if (cell.level == grid_.level()) {
        note_meeting(cell, lights);
    }
}

void CellSplitter::split_sliver(const FacePart& part, double area, NearLights::Range around,
                                std::uint32_t nearest) {
    const LitFaces::Target target = lit_.target(part);
    const NearLights::View view = near_.look(part, target, around);
    const auto lights = near_.at(view.lights);
    nearest = view.is_lit ? view.nearest : nearest;
    if (lights.empty() || near_.is_single(view.lights)) {
        give(nearest, area, lights.empty() ? area : 0);
        return;
    }
    if (flat_.find(part, target, view, lights, FlatPieces::Detail::known) && flat_.is_exact()) {
        share_out(area);
        note_near(true, lights);
        return;
    }
    if (left_ == 0 || target.reach <= std::max(kSmallestHalf, kErrorsPerHalf * near_.error())) {
        give(nearest, area, area);
        note_near(false, lights);
        return;
    }
    --left_;
    for (const FacePart& half : lit_.halves(part)) {
        split_sliver(half, area / 2, view.lights, nearest);
        near_.pop_to(view.lights);
    }
}

void CellSplitter::share_out(double area) {
    const auto functions = flat_.functions();
    double doubt = 0;
    const std::size_t first = found_->shares.size();
    for (std::size_t i = 0; i < functions.size(); ++i) {
        const double part = parts_.share(functions, i, 0);
        doubt += parts_.share(functions, i, flat_.band()) - part;
        give(flat_.samples()[i], part * area, 0);
    }
    for (std::size_t i = first; i < found_->shares.size(); ++i) {
        found_->shares[i].doubt = doubt * area;
    }
}

std::uint32_t CellSplitter::count_near(bool is_flat, std::span<const std::uint32_t> lights) {
    std::array<std::uint32_t, 3> seen{};
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t sample) {
        if (std::find(seen.begin(), seen.begin() + count, sample) == seen.begin() + count) {
            seen[count++] = sample;
        }
        return count == seen.size();
    };
    if (!is_flat) {
        for (const std::uint32_t light : lights) {
            if (add(near_.sample_of(light))) {
                break;
            }
        }
        return count;
    }
    for (std::size_t i = 0; i < flat_.functions().size(); ++i) {
        if (parts_.share(flat_.functions(), i, flat_.wide_band()) > 0 && add(flat_.samples()[i])) {
            break;
        }
    }
    return count;
}

void CellSplitter::note_near(bool is_flat, std::span<const std::uint32_t> lights) {
    const std::uint32_t near = has_dual_ ? count_near(is_flat, lights) : 0;
    meets_ |= near > 2;
    if (near == 2 && is_flat) {
        note_pair();
    } else if (near == 2) {
        const std::uint32_t first = near_.sample_of(lights.front());
        for (const std::uint32_t light : lights) {
            add_pair(*found_, first, near_.sample_of(light));
        }
    }
}

void CellSplitter::note_pair() {
    const auto [a, b, c] = flat_.nearest();
    add_pair(*found_, a, b);
    add_pair(*found_, b, c);
    add_pair(*found_, c, a);
}

std::uint32_t CellSplitter::nearest_at(const FacePlace& place,
                                       std::span<const std::uint32_t> lights) const {
    return near_.nearest_at(lit_.target(place.face, place.weights), lights).sample;
}

void CellSplitter::note_meeting(const GapCell& cell, std::span<const std::uint32_t> lights) {
    const auto corners = grid_.corners(cell);
    Meeting meeting{{}, static_cast<std::uint32_t>(knotted_.size()), false};
    knotted_.push_back(corners);
    for (std::size_t k = 0; k < 3; ++k) {
        const FacePlace place = grid_.place(corners[k]);
        const bool is_inside = corners[k].kind == GridPoint::Kind::face;
        meeting.samples[k] = nearest_at(place, is_inside ? lights : lit_.lights_of(place.face));
        if (meeting.samples[k] == ~0u) {
            return;
        }
    }
    // Pairs follow from meetings. In a knot, cells may touch on the grid alone.
    const auto [a, b, c] = meeting.samples;
    if (a != b && b != c && c != a) {
        meeting.turns_back = sort_turning(meeting.samples) != cell.is_turned;
        meetings_.push_back(meeting);
    }
}

void CellSplitter::tie_knots() {
    std::vector<KnotEnd> corners;
    for (std::uint32_t i = 0; i < knotted_.size(); ++i) {
        for (const GridPoint& corner : knotted_[i]) {
            corners.push_back({corner, i});
        }
    }
    std::ranges::sort(corners);
    VertexSets knots(knotted_.size());
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].point == corners[i - 1].point) {
            knots.join(corners[i].knot, corners[i - 1].knot);
        }
    }
    std::vector<std::uint32_t> numbers(knotted_.size());
    for (std::uint32_t i = 0; i < knotted_.size(); ++i) {
        const std::uint32_t first = knots.lowest(i);
        numbers[i] = first == i ? found_->knots++ : numbers[first];
    }
    for (Meeting meeting : meetings_) {
        meeting.knot = numbers[meeting.knot];
        found_->meetings.push_back(meeting);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const KnotEnd end{corners[i].point, numbers[corners[i].knot]};
        if (end.point.kind != GridPoint::Kind::face &&
            (i == 0 || end.point != corners[i - 1].point)) {
            found_->ends.push_back(end);
        }
    }
}

void CellSplitter::merge(FoundCells& found) {
    std::ranges::stable_sort(found.shares, {}, &CellShare::sample);
    std::size_t count = 0;
    for (const CellShare& share : found.shares) {
        if (count > 0 && found.shares[count - 1].sample == share.sample) {
            found.shares[count - 1].area += share.area;
            found.shares[count - 1].doubt += share.doubt;
        } else {
            found.shares[count++] = share;
        }
    }
    found.shares.resize(count);
    std::ranges::sort(found.pairs);
    found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
}

} // namespace geodisk
