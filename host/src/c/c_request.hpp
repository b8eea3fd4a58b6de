// Requests of the C API.
#pragma once

#include <memory>
#include <optional>

#include <geodisk/geodisk.h>
#include <geodisk/mesh_view.hpp>
#include <geodisk/request.hpp>

#include "c/c_domain.hpp"

namespace geodisk::c {

/// A request, what it refers to, and the run that serves it. Must not move.
struct RequestState {
    std::shared_ptr<DomainState> of; ///< Its one surface.
    MeshView view;
    SampleRequest request;
    std::optional<RequestRun> run; ///< If it was started.
};

/// Copies a request of the caller's.
Result<std::shared_ptr<RequestState>> request_of(const geodisk_mesh* mesh,
                                                 const geodisk_request* given);

/// Returns the surface of a request at the distance that its samples were found at.
std::shared_ptr<const DomainState> at_found_distance(RequestState& state,
                                                     const RequestedSet& found);

} // namespace geodisk::c
