#include "engine/update/update_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/domain/check_frame.hpp"
#include "engine/request/check_fields.hpp"
#include "mesh/checks.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {

Result<Done> check_sizes(const MeshView& mesh, const SampleParams& params) {
    const std::size_t faces = mesh.face_count();
    const auto check = [&](const char* what, std::size_t count) -> Result<Done> {
        return count == 0 || count == faces
                   ? Result<Done>(Done{})
                   : invalid(std::string("there are ") + what + " of " + std::to_string(count) +
                             " faces for a mesh of " + std::to_string(faces));
    };
    GEODISK_TRY(check("keys", params.face_keys.size()));
    GEODISK_TRY(check("mask bytes", params.face_mask.size()));
    const std::size_t radii = params.radii != nullptr ? params.radii->face_count() : 0;
    return check("radii", radii);
}

Result<Done> check_places(const LiveMesh& faces, const SampleParams& params) {
    const auto check = [&](const char* what, std::size_t i, std::uint32_t face) -> Result<Done> {
        return face < faces.face_count() && faces.takes_part(face)
                   ? Result<Done>(Done{})
                   : invalid(what + std::to_string(i) + " is in face " + std::to_string(face) +
                                 ", which there is not",
                             i);
    };
    for (std::size_t i = 0; i < params.existing.size(); ++i) {
        GEODISK_TRY(check("existing sample ", i, params.existing[i].face));
    }
    for (std::size_t i = 0; i < params.avoid.size(); ++i) {
        const auto& [center, radius] = params.avoid[i];
        GEODISK_TRY(check("point to avoid ", i, center.face));
        if (!(radius > 0) || !std::isfinite(radius)) {
            return invalid("point to avoid " + std::to_string(i) + " has the radius " +
                               number_text(radius) + ", not a positive number",
                           i);
        }
    }
    return Done{};
}

double density_of(const SampleParams& params) {
    return params.radii != nullptr ? params.radii->min_density() : 0;
}

Result<Done> check_same(const SampleParams& params, const JobFrame& frame, std::uint64_t seed,
                        bool has_keys, double min_density) {
    GEODISK_TRY(check_fields(params, RequestField::update));
    if (params.seed != seed) {
        return invalid("the samples have the seed " + std::to_string(seed) + ", not " +
                       std::to_string(params.seed));
    }
    GEODISK_TRY(check_job(frame, params));
    if (params.face_keys.empty() == has_keys) {
        return invalid(has_keys ? "the faces of the samples have keys, these have none"
                                : "the faces of the samples have no keys, these have");
    }
    if (density_of(params) != min_density) {
        return invalid("the edit changes the density at which radii are largest, and so all "
                       "radii; sample the surface again");
    }
    return Done{};
}

Error other_dimension(std::uint32_t before, std::uint32_t now) {
    return invalid("the surface had " + std::to_string(before) + " coordinates per vertex, not " +
                   std::to_string(now));
}

Error no_face(std::size_t sample, std::uint32_t face, std::size_t faces) {
    return invalid("sample " + std::to_string(sample) + " is in face " + std::to_string(face) +
                       ", but there are " + std::to_string(faces),
                   sample);
}

Result<Done> check_start(const SurfaceJob& job, const JobFrame& frame,
                         std::span<const Sample> samples, const ThreadOptions& threads) {
    const auto& [mesh, params] = job;
    GEODISK_TRY(check_threads(threads));
    GEODISK_TRY(check_mesh(mesh));
    GEODISK_TRY(check_fields(params, RequestField::update));
    GEODISK_TRY(check_sizes(mesh, params));
    GEODISK_TRY(check_job(frame, params));
    if (frame.unit < frame.min_distance) {
        return invalid("the minimum distance exceeds the surface, so an edit may change all "
                       "samples; sample the surface again");
    }
    const std::size_t existing = params.existing.size();
    if (samples.size() < existing ||
        !std::ranges::equal(samples.first(existing), params.existing, {}, order_of, order_of)) {
        return invalid("the samples must begin with the " + std::to_string(existing) +
                       " existing ones");
    }
    return Done{};
}

Result<Done> check_edit(const SurfaceJob& before, const SurfaceJob& after, const JobFrame& frame) {
    GEODISK_TRY(check_mesh(after.mesh));
    GEODISK_TRY(check_sizes(after.mesh, after.params));
    if (after.mesh.dimension != before.mesh.dimension) {
        return other_dimension(before.mesh.dimension, after.mesh.dimension);
    }
    return check_same(after.params, frame, before.params.seed, !before.params.face_keys.empty(),
                      density_of(before.params));
}

} // namespace geodisk
