#include "engine/cells/open_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "mesh/face_area.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kFacesPerPart = 512;
// Part of a radius by which the rim is known. Smaller parts are not split.
constexpr double kRim = 1.0 / 32;
// More than the rounding of radii.
constexpr double kInside = 1 - 0x1p-12;

class RimSearch {
  public:
    RimSearch(const LitFaces& lit, std::span<const double> radii, const Closeness& closeness,
              std::vector<std::uint32_t>& found)
        : lit_(lit), radii_(radii), near_(lit, closeness), found_(found) {}

    void search(std::uint32_t face) { search({face, 0, 0, 0, false}, near_.begin(face)); }

  private:
    void search(const GapCell& cell, NearLights::Range lights);
    /// Returns true if the light is one of a sample whose rim may be in the target.
    bool is_at_rim(std::uint32_t light, const LitFaces::Target& target, bool is_lit) const {
        return !is_lit || lit_.sight(light, target).distance + target.reach >=
                              radii_[near_.sample_of(light)] * kInside;
    }

    const LitFaces& lit_;
    std::span<const double> radii_;
    NearLights near_;
    std::vector<std::uint32_t>& found_;
};

void RimSearch::search(const GapCell& cell, NearLights::Range lights) {
    const LitFaces::Target target = lit_.target(cell);
    const NearLights::View view = near_.look(cell, target, lights);
    bool is_coarse = false;
    const std::size_t before = found_.size();
    for (const std::uint32_t light : near_.at(view.lights)) {
        if (is_at_rim(light, target, view.is_lit)) {
            const std::uint32_t sample = near_.sample_of(light);
            is_coarse = is_coarse || target.reach > kRim * radii_[sample];
            found_.push_back(sample);
        }
    }
    if (is_coarse) {
        found_.resize(before);
        for (const GapCell& child : cell.children()) {
            search(child, view.lights);
            near_.pop_to(view.lights);
        }
    }
}

} // namespace

std::vector<std::uint8_t> open_cells(const PreparedMesh& mesh, const LitFaces& lit,
                                     std::span<const double> radii, const Closeness& closeness,
                                     const ThreadOptions& threads) {
    const std::size_t parts = (mesh.face_count() + kFacesPerPart - 1) / kFacesPerPart;
    std::vector<std::vector<std::uint32_t>> found(parts);
    for_parts(threads, parts, [&](std::size_t part) {
        RimSearch search(lit, radii, closeness, found[part]);
        const std::size_t first = part * kFacesPerPart;
        const std::size_t end = std::min<std::size_t>(first + kFacesPerPart, mesh.face_count());
        for (std::size_t face = first; face < end; ++face) {
            if (has_area(mesh, static_cast<std::uint32_t>(face))) {
                search.search(static_cast<std::uint32_t>(face));
            }
        }
        std::ranges::sort(found[part]);
        const auto repeated = std::ranges::unique(found[part]);
        found[part].erase(repeated.begin(), repeated.end());
    });
    std::vector<std::uint8_t> marks(radii.size(), 0);
    for (const auto& samples : found) {
        for (const std::uint32_t sample : samples) {
            marks[sample] = 1;
        }
    }
    return marks;
}

} // namespace geodisk
