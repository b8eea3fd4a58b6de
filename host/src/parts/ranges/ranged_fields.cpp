#include "parts/ranges/ranged_fields.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "mesh/connectivity.hpp"
#include "mesh/density_values.hpp"
#include "mesh/mesh_digest.hpp"
#include "parts/ranges/borders.hpp"
#include "parts/ranges/homes.hpp"
#include "support/blocks.hpp"

namespace geodisk {
namespace {

/// Stops all processes if one has an error.
void check(Talk& talk, const char* error) {
    std::optional<Error> rejected;
    if (error != nullptr) {
        rejected = Error{Status::mesh_rejected, error};
    }
    talk.check(rejected ? &*rejected : nullptr);
}

/// Returns which vertices of the block a face that takes part uses. `numbers` are the vertices of
/// the range's faces.
std::vector<std::uint8_t> used_vertices(Talk& talk, const MeshRange& range,
                                        const VertexNumbers& numbers) {
    std::vector<std::uint8_t> by_faces(numbers.size(), 0);
    for (std::size_t face = 0; face < range.triangles.size(); face += 3) {
        const std::uint32_t* const corners = &range.triangles[face];
        for (std::size_t k = 0; k < 3 && takes_part({corners[0], corners[1], corners[2]}); ++k) {
            by_faces[numbers.of(corners[k])] = 1;
        }
    }
    std::vector<std::uint8_t> is_used(range.vertices.size(talk.rank()), 0);
    tell_homes<std::uint8_t>(
        talk, range.vertices, numbers.vertices(), [&](std::size_t i) { return by_faces[i]; },
        [&](std::size_t at, std::uint8_t used) { is_used[at] |= used; });
    return is_used;
}

/// Returns the radius factors of the block's vertices, 1 at unused ones.
std::vector<float> factors_of(Talk& talk, const MeshRange& range, const VertexNumbers& numbers) {
    const std::vector<std::uint8_t> is_used = used_vertices(talk, range, numbers);
    std::vector<float> factors;
    factors.reserve(range.values.size());
    bool are_well = true;
    for (std::size_t at = 0; at < range.values.size(); ++at) {
        const double g = is_used[at] != 0 ? range.values[at] : 1;
        are_well = are_well && g >= RadiusField::kMinFactor && g <= 1;
        factors.push_back(static_cast<float>(g));
    }
    check(talk, are_well ? nullptr : "a radius factor is not from 0.001 to 1");
    return factors;
}

/// Bounds of a density.
struct Bounds {
    double least = HUGE_VAL; ///< Above 0.
    double most = 0;
};

/// Returns the density at the block's vertices in units of the smallest packing, 0 at unused ones;
/// and that unit.
std::vector<float> scaled_density(Talk& talk, const MeshRange& range, const VertexNumbers& numbers,
                                  DensityUnit& unit) {
    const std::vector<std::uint8_t> is_used = used_vertices(talk, range, numbers);
    Bounds own;
    bool are_well = true;
    for (std::size_t at = 0; at < range.values.size(); ++at) {
        const double density = is_used[at] != 0 ? range.values[at] : 0;
        are_well = are_well && density >= 0 && std::isfinite(density);
        if (density > 0) {
            own = {std::min(own.least, density), std::max(own.most, density)};
        }
    }
    check(talk, are_well ? nullptr : "a density is negative or not finite");
    Bounds bounds;
    for (const Bounds& one : talk.all(own)) {
        bounds = {std::min(bounds.least, one.least), std::max(bounds.most, one.most)};
    }
    check(talk, bounds.most > 0 ? nullptr : "the density is 0 everywhere");
    unit = DensityUnit::of(bounds.most, bounds.least);
    std::vector<float> scaled;
    scaled.reserve(range.values.size());
    for (std::size_t at = 0; at < range.values.size(); ++at) {
        scaled.push_back(is_used[at] != 0 ? unit.scaled(range.values[at]) : 0.0f);
    }
    return scaled;
}

/// Returns the packing at the block's vertices, by the density there.
std::vector<float> packing_for(Talk& talk, const MeshRange& range, const VertexNumbers& numbers,
                               const std::vector<float>& density) {
    std::vector<float> around;
    around.reserve(numbers.size());
    fetch<float>(
        talk, range.vertices, numbers.vertices(), [&](std::size_t at) { return density[at]; },
        [&](float value) { around.push_back(value); });
    std::vector<float> needed(numbers.size(), 0.0f);
    for (std::size_t face = 0; face < range.triangles.size(); face += 3) {
        std::uint32_t corners[3];
        float most = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = numbers.of(range.triangles[face + k]);
            most = std::max(most, around[corners[k]]);
        }
        for (const std::uint32_t corner : corners) {
            needed[corner] = std::max(needed[corner], packing_in_face(most));
        }
    }
    std::vector<float> packing(density.size());
    std::ranges::transform(density, packing.begin(), packing_of_vertex);
    tell_homes<float>(
        talk, range.vertices, numbers.vertices(), [&](std::size_t i) { return needed[i]; },
        [&](std::size_t at, float value) { packing[at] = std::max(packing[at], value); });
    return packing;
}

/// Returns which faces of the range take samples.
std::vector<std::uint8_t> mask_for(Talk& talk, const MeshRange& range,
                                   const VertexNumbers& numbers) {
    std::vector<std::uint8_t> at_vertices;
    at_vertices.reserve(numbers.size());
    fetch<std::uint8_t>(
        talk, range.vertices, numbers.vertices(),
        [&](std::size_t at) { return range.vertex_mask[at]; },
        [&](std::uint8_t takes) { at_vertices.push_back(takes); });
    std::vector<std::uint8_t> mask = range.face_mask;
    std::uint64_t count = 0;
    for (std::size_t face = 0; face < mask.size(); ++face) {
        for (std::size_t k = 0; k < 3; ++k) {
            mask[face] &= at_vertices[numbers.of(range.triangles[3 * face + k])];
        }
        count += mask[face];
    }
    check(talk, talk.sum(count) > 0 ? nullptr : "the mask leaves out all faces");
    return mask;
}

/// Contribution of one process to the fields of the whole.
struct Share {
    double largest_area = 0;
    float largest_density = 0, min_factor = 1;
    std::uint64_t left_out = 0, digest = 0;
};

/// Measures the faces of a range in blocks; `first` is the number of the first one. Replaces their
/// areas by effective ones: those that count for samples. Where radii vary, `whole` gets effective
/// areas without the mask.
Share measure(const MeshRange& range, std::uint64_t first, const VertexRadii& radii,
              std::span<const std::uint8_t> mask, RangeFaces& faces, std::vector<double>& whole) {
    Share share;
    const bool vary = !radii.factors.empty();
    whole.reserve(vary ? faces.areas.size() : 0);
    for (std::size_t begin = 0; begin < faces.areas.size(); begin += kBlock) {
        const std::size_t end = std::min(begin + kBlock, faces.areas.size());
        std::optional<RadiusField> block;
        if (vary) {
            std::vector<std::uint32_t> triangles;
            triangles.reserve(3 * (end - begin));
            for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
                triangles.push_back(faces.numbers.of(range.triangles[i]));
            }
            block = RadiusPieces::on_faces(triangles, radii, [&](FaceMean mean) {
                whole.push_back(mean.over(faces.areas[whole.size()]));
            });
            share.largest_density = std::max(share.largest_density, block->largest_density());
            share.min_factor = std::min(share.min_factor, static_cast<float>(block->min_factor()));
        }
        for (std::size_t face = begin; face < end; ++face) {
            const auto in_block = static_cast<std::uint32_t>(face - begin);
            const bool takes = mask.empty() || mask[face] != 0;
            if (block || !mask.empty()) {
                share.digest +=
                    field_digest(first + face, block ? &*block : nullptr, in_block, takes);
            }
            double& area = faces.areas[face];
            const double density = block ? static_cast<double>(block->densities()[in_block]) : 1;
            share.largest_area = std::max(share.largest_area, takes ? area * density : 0);
            share.left_out += takes ? 0 : 1;
            area *= !takes ? 0 : block ? block->samples_in(in_block) : 1;
        }
    }
    return share;
}

} // namespace

RangedFields RangedFields::create(Talk& talk, const MeshRange& range, RangeFaces& faces,
                                  const MeshStatistics& statistics) {
    RangedFields fields;
    fields.kind_ = range.radii;
    DensityUnit unit;
    if (range.radii == RadiusKind::factor) {
        fields.values_ = factors_of(talk, range, faces.numbers);
    } else if (range.radii == RadiusKind::density) {
        fields.values_ = scaled_density(talk, range, faces.numbers, unit);
        fields.packing_ = packing_for(talk, range, faces.numbers, fields.values_);
    }
    if (range.has_mask) {
        fields.mask_ = mask_for(talk, range, faces.numbers);
    }

    const VertexRadii radii = fields.radii_at(talk, range.vertices, faces.numbers.vertices());
    std::vector<double> whole;
    const Share own =
        measure(range, range.faces.first(talk.rank()), radii, fields.mask_, faces, whole);
    Share all;
    for (const Share& one : talk.all(own)) {
        all.largest_area = std::max(all.largest_area, one.largest_area);
        all.largest_density = std::max(all.largest_density, one.largest_density);
        all.min_factor = std::min(all.min_factor, one.min_factor);
        all.left_out += one.left_out;
        all.digest += one.digest;
    }
    fields.digest_ = all.digest;
    if (range.has_mask) {
        fields.masked_faces_ = range.faces.count - all.left_out;
    }
    fields.largest_area_ = all.largest_area;
    fields.areas_.whole =
        fields.kind_ != RadiusKind::same ? sum_in_order(talk, whole) : statistics.area;
    fields.areas_.taken = all.left_out > 0 ? sum_in_order(talk, faces.areas) : fields.areas_.whole;
    check(talk, fields.areas_.taken > 0 ? nullptr
                                        : "no face that takes samples has an area and a density");
    if (range.needs_borders && (statistics.boundary_edges > 0 || all.left_out > 0)) {
        fields.border_length_ = border_length(talk, range, faces, radii, fields.mask_);
    }
    if (fields.kind_ != RadiusKind::same) {
        fields.outline_ = RadiusPieces::outline(
            {fields.areas_.whole, unit.min_density(), all.largest_density, all.min_factor});
    }
    return fields;
}

VertexRadii RangedFields::radii_at(Talk& talk, const MeshBlocks& blocks,
                                   std::span<const std::uint32_t> vertices) const {
    std::vector<float> values, packing;
    if (kind_ == RadiusKind::same) {
        return {};
    }
    values.reserve(vertices.size());
    fetch<float>(
        talk, blocks, vertices, [&](std::size_t at) { return values_[at]; },
        [&](float value) { values.push_back(value); });
    if (kind_ == RadiusKind::factor) {
        return VertexRadii::of_factors(std::move(values));
    }
    packing.reserve(vertices.size());
    fetch<float>(
        talk, blocks, vertices, [&](std::size_t at) { return packing_[at]; },
        [&](float value) { packing.push_back(value); });
    return VertexRadii::of_density(std::move(values), std::move(packing));
}

std::vector<std::uint8_t> RangedFields::mask_of(Talk& talk, const MeshBlocks& blocks,
                                                std::span<const std::uint32_t> faces) const {
    std::vector<std::uint8_t> mask;
    if (masked_faces_) {
        mask.reserve(faces.size());
        fetch<std::uint8_t>(
            talk, blocks, faces, [&](std::size_t at) { return mask_[at]; },
            [&](std::uint8_t takes) { mask.push_back(takes); });
    }
    return mask;
}

} // namespace geodisk
