#include "engine/update/face_reach.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geodisk {
namespace {

// Axes by which sources are gathered, and bits of a cell's number along each.
constexpr std::uint32_t kAxes = 3;
constexpr std::uint32_t kCellBits = 21;

} // namespace

void FaceReach::Box::add(const Box& other, std::uint32_t dimension) {
    for (std::uint32_t axis = 0; axis < dimension; ++axis) {
        low[axis] = std::min(low[axis], other.low[axis]);
        high[axis] = std::max(high[axis], other.high[axis]);
    }
}

FaceReach::Box FaceReach::box_of(std::uint32_t face) const {
    Box box;
    const LiveMesh::Corners& corners = faces_.corners(face);
    for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
        const auto [low, high] =
            std::minmax({mesh_.coordinate(corners[0], axis), mesh_.coordinate(corners[1], axis),
                         mesh_.coordinate(corners[2], axis)});
        box.low[axis] = low;
        box.high[axis] = high;
    }
    return box;
}

double FaceReach::square_gap(const Box& a, const Box& b) const {
    double square = 0;
    for (std::uint32_t axis = 0; axis < mesh_.dimension; ++axis) {
        const double gap = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
        square += gap * gap;
    }
    return square;
}

std::uint64_t FaceReach::cell_of(const Box& box, double width) const {
    std::uint64_t cell = 0;
    for (std::uint32_t axis = 0; axis < std::min(mesh_.dimension, kAxes); ++axis) {
        const double at = std::floor(box.low[axis] / width);
        const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(
            std::clamp(at, -0x1p62, 0x1p62))); // Equal numbers of far cells do no harm.
        cell = cell << kCellBits | (number & ((1u << kCellBits) - 1));
    }
    return cell;
}

template <class Visit>
bool FaceReach::flood(std::span<const std::uint32_t> from, const Box& box, double width,
                      const FaceSet& closed, const Visit& visit) {
    seen_.clear(faces_.face_count());
    stack_.assign(from.begin(), from.end());
    for (const std::uint32_t face : from) {
        seen_.insert(face);
    }
    bool goes_on = true;
    while (goes_on && !stack_.empty()) {
        const std::uint32_t face = stack_.back();
        stack_.pop_back();
        faces_.for_faces_around(face, [&](std::uint32_t other) {
            if (!goes_on || closed.has(other) || !seen_.insert(other)) {
                return;
            }
            const double square = square_gap(box_of(other), box);
            if (square <= width * width) {
                goes_on = visit(other, square);
                stack_.push_back(other);
            }
        });
    }
    return goes_on;
}

void FaceReach::visit_near(std::span<const std::uint32_t> sources, double width, double cell,
                           const std::function<void(std::uint32_t face, double square)>& visit) {
    sources_.clear(faces_.face_count());
    for (const std::uint32_t face : sources) {
        sources_.insert(face);
    }
    // A path that ends elsewhere leaves the sources for the last time through one at their border.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> border;
    for (const std::uint32_t face : sources_.members()) {
        bool is_inside = true;
        faces_.for_faces_around(
            face, [&](std::uint32_t other) { is_inside = is_inside && sources_.has(other); });
        if (!is_inside) {
            border.emplace_back(cell_of(box_of(face), cell), face);
        }
    }
    std::ranges::sort(border);
    std::vector<std::uint32_t> together; // The sources of a cell.
    for (auto next = border.begin(); next != border.end();) {
        const std::uint64_t here = next->first;
        Box box = box_of(next->second);
        together.clear();
        for (; next != border.end() && next->first == here; ++next) {
            together.push_back(next->second);
            box.add(box_of(next->second), mesh_.dimension);
        }
        flood(together, box, width, sources_, [&](std::uint32_t face, double square) {
            visit(face, square);
            return true;
        });
    }
}

void FaceReach::reach(std::span<const std::uint32_t> sources, std::initializer_list<Ring> rings) {
    for (const Ring& ring : rings) {
        for (const std::uint32_t face : sources) {
            ring.faces.insert(face);
        }
    }
    const double width = rings.end()[-1].width;
    visit_near(sources, width, width / 2, [&](std::uint32_t face, double square) {
        for (const Ring& ring : rings) {
            if (square <= ring.width * ring.width) {
                ring.faces.insert(face);
            }
        }
    });
}

bool FaceReach::stays_in(std::uint32_t source, double width, const FaceSet& all) {
    none_.clear(faces_.face_count());
    return all.has(source) && flood({&source, 1}, box_of(source), width, none_,
                                    [&](std::uint32_t face, double) { return all.has(face); });
}

} // namespace geodisk
