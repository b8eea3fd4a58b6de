#include "engine/cells/open_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_set>

#include "mesh/face_area.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kFacesPerSearch = 512;
// Part of a radius by which the rim is known. Smaller parts are not split.
constexpr double kRim = 1.0 / 32;
// More than the rounding of radii.
constexpr double kInside = 1 - 0x1p-12;

using Samples = std::unordered_set<std::uint32_t>;

/// Finds each sample once: faces are not split for those that are found already.
class RimSearch {
  public:
    RimSearch(const LitFaces& lit, std::span<const double> radii, const Closeness& closeness,
              Samples& found)
        : lit_(lit), radii_(radii), near_(lit, closeness), found_(found) {}

    void search(std::uint32_t face) {
        const GapCell whole{face, 0, 0, 0, false};
        const NearLights::Range lights = near_.begin(face);
        if (lit_.is_sliver(face)) {
            search(whole.part(), lights);
        } else {
            search(whole, lights);
        }
    }

  private:
    /// `Part` is a cell of the grid, or any part of a face.
    template <class Part>
    void search(const Part& part, NearLights::Range lights);
    static const FacePart& part_of(const FacePart& part) { return part; }
    static FacePart part_of(const GapCell& cell) { return cell.part(); }
    std::array<FacePart, 2> pieces_of(const FacePart& part) const { return lit_.halves(part); }
    std::array<GapCell, 4> pieces_of(const GapCell& cell) const { return cell.children(); }
    /// Returns true if the light is one of a sample whose rim may be in the target.
    bool is_at_rim(std::uint32_t light, const LitFaces::Target& target, bool is_lit) const {
        return !is_lit || lit_.sight(light, target).distance + target.reach >=
                              radii_[near_.sample_of(light)] * kInside;
    }

    const LitFaces& lit_;
    std::span<const double> radii_;
    NearLights near_;
    Samples& found_;
};

template <class Part>
void RimSearch::search(const Part& part, NearLights::Range lights) {
    const LitFaces::Target target = lit_.target(part);
    const NearLights::View view = near_.look(part_of(part), target, lights);
    const auto is_new = [&](std::uint32_t light) {
        return !found_.contains(near_.sample_of(light)) && is_at_rim(light, target, view.is_lit);
    };
    const auto is_coarse = [&](std::uint32_t light) {
        return target.reach > kRim * radii_[near_.sample_of(light)] && is_new(light);
    };
    if (std::ranges::any_of(near_.at(view.lights), is_coarse)) {
        for (const auto& piece : pieces_of(part)) {
            search(piece, view.lights);
            near_.pop_to(view.lights);
        }
        return;
    }
    for (const std::uint32_t light : near_.at(view.lights)) {
        if (is_new(light)) {
            found_.insert(near_.sample_of(light));
        }
    }
}

} // namespace

std::vector<std::uint8_t> open_cells(const PreparedMesh& mesh, const LitFaces& lit,
                                     std::span<const double> radii, const Closeness& closeness,
                                     const ThreadOptions& threads) {
    const std::size_t parts = (mesh.face_count() + kFacesPerSearch - 1) / kFacesPerSearch;
    std::vector<Samples> found(parts);
    for_parts(threads, parts, [&](std::size_t part) {
        RimSearch search(lit, radii, closeness, found[part]);
        const std::size_t first = part * kFacesPerSearch;
        const std::size_t end = std::min<std::size_t>(first + kFacesPerSearch, mesh.face_count());
        for (std::size_t face = first; face < end; ++face) {
            if (has_area(mesh, static_cast<std::uint32_t>(face))) {
                search.search(static_cast<std::uint32_t>(face));
            }
        }
    });
    std::vector<std::uint8_t> marks(radii.size(), 0);
    for (const Samples& samples : found) {
        for (const std::uint32_t sample : samples) {
            marks[sample] = 1;
        }
    }
    return marks;
}

} // namespace geodisk
