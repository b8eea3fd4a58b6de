// Candidates that the host gives, in place of those that kernels draw from a seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/checkpoint.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/device_mesh.hpp"
#include "engine/domain/placed_surface.hpp"

namespace geodisk {

/// Makes the domain of a surface whose only candidates are these, decided in the order of the list
/// after the existing samples of `params`. Samples are the accepted ones in that order, behind the
/// existing ones. The seed and the pool ratio have no effect. Kernels draw nothing: a recorded job
/// must upload the data again before it restarts. `mesh` and `params` as for Domain::surface().
///
/// Errors: those of Domain::surface(); `invalid_argument` for no candidate, more than 2^28,
/// `darts`, classes, or a candidate, naming it, in a face that does not exist or with weights
/// that sum to more than 1.
GEODISK_API Result<Domain> listed_domain(const PreparedMesh& mesh, const SampleParams& params,
                                         std::span<const ListedCandidate> candidates) noexcept;

/// Makes the same in a frame: that of `mesh` itself, or of a mesh that it is a part of. `classes`
/// has those of the candidates, if samples have any; there are then at most 2^25. Errors: those
/// above, and of Domain::surface() in a frame.
GEODISK_API Result<Domain> listed_domain(const PreparedMesh& mesh, const SampleParams& params,
                                         const JobFrame& frame,
                                         std::span<const ListedCandidate> candidates,
                                         std::span<const std::uint8_t> classes = {}) noexcept;

/// Returns the sample at a candidate.
Sample to_sample(const ListedCandidate& candidate);

/// Returns where in a list the samples of a run on it are, which come in its order. Errors:
/// `internal` for a sample that is none of them.
Result<std::vector<std::size_t>> places_of(std::span<const Sample> samples,
                                           std::span<const ListedCandidate> list);

/// Listed candidates on the device: the contents of these buffers.
struct ListedBuffers {
    std::vector<std::uint32_t> starts, cells, weights, orders;
    std::vector<std::uint32_t>
        numbers; ///< In the list, of the candidate at each place. Not uploaded.
};

/// Returns the stages of a job with so many candidates of the host: a single one.
Stages listed_stages(double samples, std::size_t candidates, CandidateSource source);

/// Sorts the candidates by face and cell. `classes` may be empty.
ListedBuffers listed_buffers(const PlacedSurface& surface, const FaceCells& cells,
                             std::span<const ListedCandidate> candidates,
                             std::span<const std::uint8_t> classes = {});

} // namespace geodisk
