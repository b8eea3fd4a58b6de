// The domains of the C API.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/geodisk.h>

#include "c/c_mesh.hpp"

namespace geodisk::c {

/// A surface of a domain, and all that its C++ counterpart refers to.
struct Part {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Radii> radii;
    std::vector<std::uint32_t> face_keys;
    SampleParams params;
};

/// What is sampled: surfaces, or a box where there are none. Stays where it is.
struct DomainState {
    std::vector<Part> parts;
    double min_distance = 0; ///< Of the first.
    std::optional<Domain> domain;

    bool is_box() const noexcept { return parts.empty(); }
};

} // namespace geodisk::c

struct geodisk_domain {
    std::shared_ptr<const geodisk::c::DomainState> shared;
};
