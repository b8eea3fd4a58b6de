// Checks for what can be updated, and errors for what cannot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include <geodisk/update.hpp>

#include "engine/domain/existing.hpp"
#include "engine/update/live_mesh.hpp"

namespace geodisk {

/// Returns what tells existing samples apart.
inline auto order_of(const Sample& sample) {
    const auto [second, third] = rounded_weights(sample.weights);
    return std::tuple(sample.face, second, third);
}

inline auto order_of_avoided(const KeepOut& avoided) {
    return std::tuple_cat(order_of(avoided.center), std::tuple(avoided.radius));
}

/// Returns RadiusField::min_density() of the parameters, or 0.
double density_of(const SampleParams& params);

/// Checks the sizes of what the parameters say of faces.
Result<Done> check_sizes(const MeshView& mesh, const SampleParams& params);

/// Checks that existing samples and points to avoid are in faces that take part.
Result<Done> check_places(const LiveMesh& faces, const SampleParams& params);

/// Checks that parameters are those of an updater, but for what an edit may change.
Result<Done> check_same(const SampleParams& params, const JobFrame& frame, std::uint64_t seed,
                        bool has_keys, double min_density);

/// Checks a job and the samples that an updater begins with.
Result<Done> check_start(const SurfaceJob& job, const JobFrame& frame,
                         std::span<const Sample> samples, const ThreadOptions& threads);

/// Checks that a job is another's after an edit.
Result<Done> check_edit(const SurfaceJob& before, const SurfaceJob& after, const JobFrame& frame);

Error other_dimension(std::uint32_t before, std::uint32_t now);
Error no_face(std::size_t sample, std::uint32_t face, std::size_t faces);

} // namespace geodisk
