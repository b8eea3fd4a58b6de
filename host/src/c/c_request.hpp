// Requests of the C API.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/geodisk.h>
#include <geodisk/mesh_view.hpp>
#include <geodisk/request.hpp>

#include "c/c_domain.hpp"

namespace geodisk::c {

/// A request and what it refers to. Must not move.
struct RequestState {
    std::shared_ptr<DomainState> of; ///< Its one surface, or a box.
    MeshView view;
    std::vector<std::uint32_t> class_counts;
    SampleRequest request; ///< Request for a surface.
    BoxRequest box;        ///< Request for a box.
};

/// Requests, and what serves them.
struct RequestsState {
    std::vector<std::shared_ptr<RequestState>> each; ///< On surfaces; or one in a box.
    std::optional<StartedRequests> started;          ///< If they were.

    /// Returns those on surfaces.
    std::vector<MeshRequest> on_meshes() const;
    /// Starts to sample what is asked for.
    Result<StartedRequests> start(Runner& runner, const ProgressCallback& progress) const;
    /// Samples what is asked for, and waits.
    Result<std::vector<RequestedSet>> sample(Runner& runner,
                                             const ProgressCallback& progress) const;
};

/// Copies a request of the caller's.
Result<std::shared_ptr<RequestState>> request_of(const geodisk_mesh* mesh,
                                                 const geodisk_request* given);

/// Copies requests of the caller's.
Result<std::shared_ptr<RequestsState>> requests_of(const geodisk_mesh_request* requests,
                                                   std::size_t count);

/// Copies a request of the caller's for a box.
Result<std::shared_ptr<RequestsState>> requests_of(const geodisk_box_request* request);

/// Returns the surface or box of a request at the distance that its samples were found at.
Result<std::shared_ptr<const DomainState>> at_found_distance(RequestState& state,
                                                             const RequestedSet& found);

} // namespace geodisk::c
