#include "engine/domain/face_mask.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "engine/domain/device_mesh.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kWordBits = 32;

bool has_mask(const PlacedSurface& surface) {
    return !surface.params.face_mask.empty();
}

} // namespace

double whole_area(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return params.radii != nullptr ? params.radii->effective_area() : mesh.statistics().area;
}

Result<Done> check_mask_size(const PreparedMesh& mesh, std::span<const std::uint8_t> mask) {
    if (!mask.empty() && mask.size() != mesh.face_count()) {
        return invalid("the face mask is for " + std::to_string(mask.size()) +
                       " faces, the mesh has " + std::to_string(mesh.face_count()));
    }
    return Done{};
}

Result<Done> check_mask(const PreparedMesh& mesh, const SampleParams& params) {
    if (params.face_mask.empty()) {
        return Done{};
    }
    GEODISK_TRY(check_mask_size(mesh, params.face_mask));
    if (std::ranges::count(params.face_mask, 0) == std::ptrdiff_t{mesh.face_count()}) {
        return invalid("the face mask leaves out all faces, so no samples fit");
    }
    if (!(effective_area(mesh, params) > 0)) {
        return invalid(params.radii != nullptr
                           ? "the density is 0 or there is no area on all faces that the face "
                             "mask leaves, so no samples fit"
                           : "no face that the face mask leaves has an area, so no samples fit");
    }
    return Done{};
}

std::size_t mask_bytes(PlacedSurfaces surfaces) {
    if (std::ranges::none_of(surfaces, has_mask)) {
        return 0;
    }
    const std::size_t bits_per_row = kRowBytes * 8;
    return (face_count(surfaces) + bits_per_row - 1) / bits_per_row * kRowBytes;
}

void add_mask(PlacedSurfaces surfaces, UploadParts& parts) {
    std::vector<std::uint32_t> words(mask_bytes(surfaces) / sizeof(std::uint32_t));
    if (words.empty()) {
        return;
    }
    for (const PlacedSurface& surface : surfaces) {
        for (std::uint32_t face = 0; face < surface.mesh->face_count(); ++face) {
            const std::uint32_t bit = surface.first_face + face;
            const std::uint32_t takes = takes_samples(surface.params, face) ? 1 : 0;
            words[bit / kWordBits] |= takes << bit % kWordBits;
        }
    }
    const std::size_t count = words.size();
    const auto kept = std::make_shared<const std::vector<std::uint32_t>>(std::move(words));
    parts.push_back(
        {sizeof(std::uint32_t), count, [kept](std::size_t begin, std::size_t end, std::byte* out) {
             std::memcpy(out, kept->data() + begin, (end - begin) * sizeof(std::uint32_t));
         }});
}

} // namespace geodisk
