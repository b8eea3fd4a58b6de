#include "parts/ranges/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace geodisk {
namespace {

constexpr std::uint32_t kBits = 21; ///< Bits of each axis.
constexpr std::uint32_t kPlaceBits = 3 * kBits + 32;

/// Returns the place of a cell along a Hilbert curve (Skilling 2004).
std::uint64_t hilbert_place(std::array<std::uint32_t, 3> cell) {
    for (std::uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& axis : cell) {
            if ((axis & bit) != 0) {
                cell[0] ^= below;
            } else {
                const std::uint32_t swapped = (cell[0] ^ axis) & below;
                cell[0] ^= swapped;
                axis ^= swapped;
            }
        }
    }
    cell[1] ^= cell[0];
    cell[2] ^= cell[1];
    std::uint32_t gray = 0;
    for (std::uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        if ((cell[2] & bit) != 0) {
            gray ^= bit - 1;
        }
    }
    std::uint64_t place = 0;
    for (std::uint32_t bit = kBits; bit-- > 0;) {
        for (const std::uint32_t axis : cell) {
            place = place << 1 | ((axis ^ gray) >> bit & 1u);
        }
    }
    return place;
}

/// PlaceOnCurve of a face in the order of the curve. No two faces have the same.
struct PlaceOnCurve {
    std::uint64_t on_curve = 0;
    std::uint32_t face = 0; ///< In the whole.

    auto operator<=>(const PlaceOnCurve&) const = default;

    /// Returns the place with a bit set, of kPlaceBits.
    PlaceOnCurve with(std::uint32_t bit) const {
        PlaceOnCurve place = *this;
        if (bit < 32) {
            place.face |= std::uint32_t{1} << bit;
        } else {
            place.on_curve |= std::uint64_t{1} << (bit - 32);
        }
        return place;
    }
};

/// The faces of one process in order, and their work.
struct Sorted {
    std::vector<PlaceOnCurve> places;
    std::vector<std::uint64_t> work; ///< Work of all faces before; one entry more than faces.

    std::size_t before(const PlaceOnCurve& place) const {
        return static_cast<std::size_t>(std::ranges::lower_bound(places, place) - places.begin());
    }
};

/// Faces and work before a place, of all processes.
struct Before {
    std::uint64_t faces = 0, work = 0;
};

std::vector<Before> before_all(Talk& talk, const Sorted& own,
                               const std::vector<PlaceOnCurve>& ends) {
    std::vector<std::uint64_t> counts;
    for (const PlaceOnCurve& end : ends) {
        const std::size_t faces = own.before(end);
        counts.insert(counts.end(), {faces, own.work[faces]});
    }
    counts = talk.sums(std::move(counts));
    std::vector<Before> all(ends.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = {counts[2 * i], counts[2 * i + 1]};
    }
    return all;
}

/// Returns for each part but the last a place before which lie as many faces as before the highest
/// place that `is_within` allows, by the part's number. `all` is what lies before the end.
template <class Within>
std::vector<PlaceOnCurve> find_ends(Talk& talk, const Sorted& own, const Before& all,
                                    const Within& is_within) {
    std::vector<PlaceOnCurve> ends(talk.size() - 1);
    // Faces before the end, and before the places that are too high.
    std::vector<std::uint64_t> low(ends.size(), 0), high(ends.size(), all.faces);
    for (std::uint32_t bit = kPlaceBits; bit-- > 0 && low != high;) {
        std::vector<PlaceOnCurve> tried;
        tried.reserve(ends.size());
        for (const PlaceOnCurve& end : ends) {
            tried.push_back(end.with(bit));
        }
        const std::vector<Before> before = before_all(talk, own, tried);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (is_within(i, before[i])) {
                ends[i] = tried[i];
                low[i] = before[i].faces;
            } else {
                high[i] = before[i].faces;
            }
        }
    }
    return ends;
}

/// Returns the ends of all parts but the last: a part has the faces before its end.
std::vector<PlaceOnCurve> ends_of_parts(Talk& talk, const Sorted& own, std::uint64_t faces) {
    const std::uint64_t parts = talk.size();
    const Before all{faces, talk.sum(own.work.back())};
    std::vector<PlaceOnCurve> ends =
        find_ends(talk, own, all, [&](std::size_t part, const Before& before) {
            return before.work <= all.work / parts * (part + 1);
        });
    // Each part has a face, also where a few have all the work.
    const std::vector<Before> before = before_all(talk, own, ends);
    std::vector<std::uint64_t> counts;
    for (std::size_t part = 0; part < ends.size(); ++part) {
        const std::uint64_t least = counts.empty() ? 1 : counts.back() + 1;
        counts.push_back(std::clamp(before[part].faces, least, faces - (parts - part - 1)));
    }
    return find_ends(talk, own, all, [&](std::size_t part, const Before& some) {
        return some.faces <= counts[part];
    });
}

/// Returns the work of a face that has a part of the area, in integers, which add up alike in any
/// order.
std::uint64_t work_of(double part, std::uint64_t faces) {
    constexpr double kUnit = 0x1p16;
    const double by_area = part * static_cast<double>(faces);
    return static_cast<std::uint64_t>(kUnit * (1 + by_area));
}

PlaceOnCurve place_of(const MeshRange& range, const RangeFaces& faces,
                      const RangeFindings& findings, std::uint32_t first, std::size_t face) {
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum +=
                faces.positions[std::size_t{3} * faces.numbers.of(range.triangles[3 * face + k]) +
                                axis];
        }
        const double size = findings.high[axis] - findings.low[axis];
        const double part = size > 0 ? (sum / 3 - findings.low[axis]) / size : 0;
        const double cells = double{1u << kBits};
        cell[axis] = static_cast<std::uint32_t>(std::clamp(part * cells, 0.0, cells - 1));
    }
    return {hilbert_place(cell), first + static_cast<std::uint32_t>(face)};
}

} // namespace

std::vector<std::uint32_t> divide_by_curve(Talk& talk, const MeshRange& range, RangeFaces faces,
                                           const RangeFindings& findings, double area) {
    const std::size_t count = faces.areas.size();
    const auto first = static_cast<std::uint32_t>(range.faces.first(talk.rank()));
    Sorted own;
    own.places.reserve(count);
    for (std::size_t face = 0; face < count; ++face) {
        own.places.push_back(place_of(range, faces, findings, first, face));
    }
    const std::vector<double> areas = std::move(faces.areas);
    faces = {VertexNumbers({}), {}, {}};
    std::sort(own.places.begin(), own.places.end());
    own.work.reserve(count + 1);
    own.work.assign(1, 0);
    for (const PlaceOnCurve& place : own.places) {
        own.work.push_back(own.work.back() +
                           work_of(areas[place.face - first] / area, range.faces.count));
    }
    std::vector<std::uint32_t> owners(count);
    const std::vector<PlaceOnCurve> ends = ends_of_parts(talk, own, range.faces.count);
    std::uint32_t part = 0;
    for (const PlaceOnCurve& place : own.places) {
        while (part < ends.size() && !(place < ends[part])) {
            ++part;
        }
        owners[place.face - first] = part;
    }
    return owners;
}

} // namespace geodisk
