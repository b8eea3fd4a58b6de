#include "engine/update/match.hpp"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "engine/domain/face_mask.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};

/// Returns for each face before the one after with the same key, or kNoFace.
std::vector<std::uint32_t> by_key(const SurfaceJob& before, const SurfaceJob& after) {
    const auto count = static_cast<std::uint32_t>(before.mesh.face_count());
    const auto new_count = static_cast<std::uint32_t>(after.mesh.face_count());
    std::vector<std::uint32_t> same(count, kNoFace);
    if (before.params.face_keys.empty()) {
        for (std::uint32_t face = 0; face < std::min(count, new_count); ++face) {
            same[face] = face;
        }
        return same;
    }
    std::unordered_map<std::uint32_t, std::uint32_t> with_key;
    with_key.reserve(new_count);
    for (std::uint32_t face = 0; face < new_count; ++face) {
        with_key.emplace(after.params.face_keys[face], face);
    }
    for (std::uint32_t face = 0; face < count; ++face) {
        const auto found = with_key.find(before.params.face_keys[face]);
        same[face] = found == with_key.end() ? kNoFace : found->second;
    }
    return same;
}

bool have_same_values(std::span<const float> a, std::uint32_t face, std::span<const float> b,
                      std::uint32_t other) {
    return a.empty() ? b.empty()
                     : !b.empty() && std::ranges::equal(a.subspan(std::size_t{3} * face, 3),
                                                        b.subspan(std::size_t{3} * other, 3));
}

bool are_same(const SurfaceJob& before, std::uint32_t face, const SurfaceJob& after,
              std::uint32_t other) {
    const auto corners = before.mesh.triangles.face(face);
    const auto new_corners = after.mesh.triangles.face(other);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::uint32_t axis = 0; axis < before.mesh.dimension; ++axis) {
            if (before.mesh.coordinate(corners[k], axis) !=
                after.mesh.coordinate(new_corners[k], axis)) {
                return false;
            }
        }
    }
    if (takes_samples(before.params, face) != takes_samples(after.params, other)) {
        return false;
    }
    const RadiusField* const radii = before.params.radii;
    const RadiusField* const new_radii = after.params.radii;
    return radii == nullptr ||
           (have_same_values(radii->factors(), face, new_radii->factors(), other) &&
            have_same_values(radii->spreads(), face, new_radii->spreads(), other) &&
            have_same_values(radii->packing(), face, new_radii->packing(), other));
}

/// Pairs of a vertex before and one after, each in a single pair.
class VertexPairs {
  public:
    VertexPairs(std::size_t before, std::size_t after)
        : after_(before, kNoVertex), before_(after, kNoVertex) {}

    /// Returns true if these may be one vertex, and from then on they are.
    bool join(std::uint32_t vertex, std::uint32_t other) {
        if (after_[vertex] == kNoVertex && before_[other] == kNoVertex) {
            after_[vertex] = other;
            before_[other] = vertex;
        }
        return after_[vertex] == other && before_[other] == vertex;
    }

  private:
    std::vector<std::uint32_t> after_, before_;
};

} // namespace

FaceMatch match_faces(const SurfaceJob& before, const SurfaceJob& after) {
    FaceMatch match;
    match.kept = by_key(before, after);
    VertexPairs pairs(before.mesh.vertex_count(), after.mesh.vertex_count());
    std::vector<bool> is_kept(after.mesh.face_count(), false);
    std::vector<bool> is_touched(before.mesh.vertex_count(), false);
    for (std::uint32_t face = 0; face < match.kept.size(); ++face) {
        std::uint32_t& other = match.kept[face];
        const auto corners = before.mesh.triangles.face(face);
        bool stays = other != kNoFace && are_same(before, face, after, other);
        for (std::size_t k = 0; stays && k < 3; ++k) {
            stays = pairs.join(corners[k], after.mesh.triangles.face(other)[k]);
        }
        if (stays) {
            is_kept[other] = true;
            continue;
        }
        other = kNoFace;
        for (const std::uint32_t vertex : corners) {
            is_touched[vertex] = true;
        }
    }
    for (std::uint32_t face = 0; face < match.kept.size(); ++face) {
        const auto corners = before.mesh.triangles.face(face);
        if (match.kept[face] != kNoFace &&
            std::ranges::any_of(corners, [&](std::uint32_t v) { return is_touched[v]; })) {
            match.changed.push_back(match.kept[face]);
        }
    }
    for (std::uint32_t face = 0; face < is_kept.size(); ++face) {
        if (!is_kept[face]) {
            match.changed.push_back(face);
        }
    }
    return match;
}

} // namespace geodisk
