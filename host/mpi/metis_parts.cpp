// Parts of a surface by METIS: cells of the graph of faces, which edges join.
#include <metis.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cut_surface.hpp"

namespace geodisk {
namespace {

// Weights are integers: so many in all.
constexpr double kWeight = 1u << 30;
// With fewer faces in each part, METIS has no good answer, or none.
constexpr std::uint32_t kLeastFaces = 16;

} // namespace

std::vector<std::uint32_t> metis_parts(const PreparedMesh& mesh, std::span<const double> work,
                                       std::uint32_t parts) {
    const std::uint32_t faces = mesh.face_count();
    if (parts < 2 || faces / parts < kLeastFaces) {
        return {};
    }
    std::vector<idx_t> starts{0}, beside, weights;
    starts.reserve(faces + 1);
    for (std::uint32_t face = 0; face < faces; ++face) {
        const std::size_t first = beside.size();
        for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
            const auto next = [&](std::uint32_t edge) {
                return around_half_edge(mesh.half_edges()[edge].around);
            };
            for (std::uint32_t other = next(h); other != h; other = next(other)) {
                beside.push_back(static_cast<idx_t>(other / 3));
            }
        }
        const auto begin = beside.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, beside.end());
        beside.erase(std::unique(begin, beside.end()), beside.end());
        starts.push_back(static_cast<idx_t>(beside.size()));
        weights.push_back(std::max<idx_t>(1, static_cast<idx_t>(std::round(work[face] * kWeight))));
    }
    if (beside.size() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max())) {
        return {};
    }
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    auto count = static_cast<idx_t>(faces);
    auto part_count = static_cast<idx_t>(parts);
    idx_t constraints = 1, cut = 0;
    std::vector<idx_t> found(faces);
    const int status = METIS_PartGraphKway(&count, &constraints, starts.data(), beside.data(),
                                           weights.data(), nullptr, nullptr, &part_count, nullptr,
                                           nullptr, options, &cut, found.data());
    return status == METIS_OK ? std::vector<std::uint32_t>(found.begin(), found.end())
                              : std::vector<std::uint32_t>();
}

} // namespace geodisk
