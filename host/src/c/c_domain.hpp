// Domains of the C API.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/geodisk.h>

#include "c/c_mesh.hpp"

namespace geodisk::c {

/// A surface of a domain, and everything that its C++ counterpart refers to.
struct Part {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Radii> radii;
    std::vector<std::uint32_t> face_keys;
    std::vector<Sample> existing;
    std::vector<std::uint8_t> face_mask;
    std::vector<KeepOut> avoid;
    std::vector<float> class_factors;
    std::vector<std::uint8_t> existing_classes, avoid_classes;
    std::vector<float> class_shares;
    SampleParams params;
};

/// Fills in a part, and returns what it was given as `params`. The part must not move afterwards:
/// its parameters refer to its data.
Result<geodisk_surface_params> fill_part(const geodisk_mesh* mesh,
                                         const geodisk_surface_params* params, Part& part);

/// Copies the parameters of a box.
Result<BoxParams> box_of(const geodisk_box_params* params);

/// Returns a metric through space. Errors: for none of the three, and for geodesic distances.
Result<Metric> metric_of(geodisk_metric metric);

/// A domain with its surfaces, or a box if there are none. Must not move.
struct DomainState {
    std::vector<Part> parts;
    double min_distance = 0;      ///< Minimum distance of the first surface.
    std::optional<Domain> domain; ///< Empty for a surface whose samples were updated,
                                  ///< or took several runs.

    bool is_box() const noexcept { return parts.empty(); }
};

} // namespace geodisk::c

struct geodisk_domain {
    std::shared_ptr<const geodisk::c::DomainState> shared;
};
