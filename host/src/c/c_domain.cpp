#include "c/c_domain.hpp"

#include <cstring>
#include <span>
#include <string>
#include <utility>

#include <geodisk/box.hpp>
#include <geodisk/features.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/levels.hpp>

#include "c/c_call.hpp"
#include "engine/domain/stages.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

static_assert(sizeof(geodisk_job_frame) == kJobFrameBytes);

/// Fills in a part. Its params refer to data of the part, so it must not move afterwards.
Result<Done> fill(const geodisk_mesh* mesh, const geodisk_surface_params& given, Part& part) {
    if (mesh == nullptr) {
        return wrong("mesh is NULL");
    }
    part.mesh = mesh->shared;
    part.params.min_distance = given.min_distance;
    part.params.seed = given.seed;
    if (given.pool_ratio != 0) {
        part.params.pool_ratio = given.pool_ratio;
    }
    part.params.darts = given.darts;
    part.params.stop_count = given.stop_count;
    if (given.radii != nullptr) {
        part.radii = given.radii->shared;
        if (part.radii->mesh != part.mesh->prepared.identity()) {
            return wrong("params->radii are of another mesh");
        }
        part.params.radii = &part.radii->field;
    }
    if (given.face_keys != nullptr) {
        part.face_keys.assign(given.face_keys, given.face_keys + part.mesh->prepared.face_count());
        part.params.face_keys = part.face_keys;
    }
    if (given.face_mask != nullptr) {
        part.face_mask.assign(given.face_mask, given.face_mask + part.mesh->prepared.face_count());
        part.params.face_mask = part.face_mask;
    }
    if (given.existing == nullptr && given.existing_count != 0) {
        return wrong("params->existing is NULL");
    }
    for (std::size_t i = 0; i < given.existing_count; ++i) {
        part.existing.push_back(sample_of(given.existing[i]));
    }
    part.params.existing = part.existing;
    if ((given.avoid == nullptr || given.avoid_radii == nullptr) && given.avoid_count != 0) {
        return wrong("params->avoid or params->avoid_radii is NULL");
    }
    for (std::size_t i = 0; i < given.avoid_count; ++i) {
        part.avoid.push_back({sample_of(given.avoid[i]), given.avoid_radii[i]});
    }
    part.params.avoid = part.avoid;
    if (given.class_factors == nullptr && given.class_count != 0) {
        return wrong("params->class_factors is NULL");
    }
    if (given.class_factors != nullptr) {
        if (given.class_count < 2 || given.class_count > kMaxClasses) {
            return wrong("params->class_count is " + std::to_string(given.class_count) +
                         ", not from 2 to 8");
        }
        part.class_factors.assign(given.class_factors,
                                  given.class_factors + given.class_count * given.class_count);
        part.params.class_factors = part.class_factors;
    }
    if (given.existing_classes != nullptr) {
        part.existing_classes.assign(given.existing_classes,
                                     given.existing_classes + given.existing_count);
        part.params.existing_classes = part.existing_classes;
    }
    if (given.avoid_classes != nullptr) {
        part.avoid_classes.assign(given.avoid_classes, given.avoid_classes + given.avoid_count);
        part.params.avoid_classes = part.avoid_classes;
    }
    if (given.class_shares != nullptr && given.class_count == 0) {
        return wrong("params->class_shares is for classes, and params->class_count is 0");
    }
    if (given.class_shares != nullptr) {
        const std::size_t of_class = std::size_t{3} * part.mesh->prepared.face_count();
        part.class_shares.assign(given.class_shares,
                                 given.class_shares + given.class_count * of_class);
        part.params.class_shares = part.class_shares;
    }
    part.params.maximal = given.is_maximal != 0;
    return Done{};
}

/// The state of a domain of one surface, to fill in.
std::shared_ptr<DomainState> state_of_one() {
    auto state = std::make_shared<DomainState>();
    state->parts.resize(1);
    return state;
}

Result<Domain> make_surface(const Part& part, geodisk_metric metric) {
    if (metric == GEODISK_GEODESIC) {
        return Domain::surface(part.mesh->prepared, part.params);
    }
    const auto through_space = metric_of(metric);
    GEODISK_TRY(through_space);
    if (part.mesh->dimension == 0) {
        return wrong("params->metric needs coordinates, which the mesh lacks");
    }
    return Domain::surface_in_space(part.mesh->view(), part.mesh->prepared, part.params,
                                    *through_space);
}

Result<Done> keep(Result<Domain> made, std::shared_ptr<DomainState> state,
                  geodisk_domain** domain) {
    GEODISK_TRY(made);
    state->domain = std::move(*made);
    *domain = new geodisk_domain{std::move(state)};
    return Done{};
}

Result<Done> check_count(double count) {
    if (!(count >= 1) || !(count <= kMaxCandidates)) {
        return wrong("count is " + exact_text(count) + ", not from 1 to 4294967295");
    }
    return Done{};
}

double factor_of(double factor) {
    return factor == 0 ? kLevelFactor : factor;
}

} // namespace

Result<BoxParams> box_of(const geodisk_box_params* params) {
    const auto given = taken(params, "params");
    GEODISK_TRY(given);
    if (given->extents == nullptr) {
        return wrong("params->extents is NULL");
    }
    if (given->dimension < 1 || given->dimension > kMaxBoxDimensions) {
        return wrong("params->dimension is " + std::to_string(given->dimension) +
                     ", not from 1 to 6");
    }
    BoxParams box;
    box.extents.assign(given->extents, given->extents + given->dimension);
    box.is_periodic = given->is_periodic != 0;
    box.min_distance = given->min_distance;
    box.seed = given->seed;
    if (given->pool_ratio != 0) {
        box.pool_ratio = given->pool_ratio;
    }
    box.darts = given->darts;
    box.stop_count = given->stop_count;
    return box;
}

Result<Metric> metric_of(geodisk_metric metric) {
    if (metric != GEODISK_EUCLIDEAN && metric != GEODISK_APPROXIMATE) {
        return wrong("params->metric is none of the three");
    }
    return metric == GEODISK_EUCLIDEAN ? Metric::euclidean : Metric::approximate;
}

Result<geodisk_surface_params> fill_part(const geodisk_mesh* mesh,
                                         const geodisk_surface_params* params, Part& part) {
    const auto given = taken(params, "params");
    GEODISK_TRY(given);
    GEODISK_TRY(fill(mesh, *given, part));
    return *given;
}

} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_domain_surface(const geodisk_mesh* mesh,
                                      const geodisk_surface_params* params, geodisk_domain** domain,
                                      geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        const auto state = state_of_one();
        const auto given = fill_part(mesh, params, state->parts[0]);
        GEODISK_TRY(given);
        state->min_distance = given->min_distance;
        return keep(make_surface(state->parts[0], given->metric), state, domain);
    });
}

geodisk_status geodisk_job_frame_of(const geodisk_mesh* mesh, const geodisk_surface_params* params,
                                    geodisk_job_frame* frame, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (frame == nullptr) {
            return wrong("frame is NULL");
        }
        Part part;
        GEODISK_TRY(fill_part(mesh, params, part));
        const auto made = frame_of(part.mesh->prepared, part.params);
        GEODISK_TRY(made);
        const auto bytes = to_bytes(*made);
        std::memcpy(frame->bytes, bytes.data(), bytes.size());
        return Done{};
    });
}

geodisk_status geodisk_domain_surface_in_frame(const geodisk_mesh* mesh,
                                               const geodisk_surface_params* params,
                                               const geodisk_job_frame* frame,
                                               geodisk_domain** domain, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (domain == nullptr || frame == nullptr) {
            return wrong("domain or frame is NULL");
        }
        const auto state = state_of_one();
        Part& part = state->parts[0];
        const auto given = fill_part(mesh, params, part);
        GEODISK_TRY(given);
        if (given->metric != GEODISK_GEODESIC) {
            return wrong("params->metric: frames are for geodesic distances only");
        }
        const auto of_whole = frame_from_bytes(std::as_bytes(std::span(frame->bytes)));
        GEODISK_TRY(of_whole);
        state->min_distance = given->min_distance;
        return keep(Domain::surface(part.mesh->prepared, part.params, *of_whole), state, domain);
    });
}

geodisk_status geodisk_domain_features(const geodisk_mesh* mesh,
                                       const geodisk_surface_params* params, double degrees,
                                       size_t* corners, geodisk_domain** domain,
                                       geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        const auto state = state_of_one();
        Part& part = state->parts[0];
        const auto given = fill_part(mesh, params, part);
        GEODISK_TRY(given);
        if (given->metric != GEODISK_GEODESIC) {
            return wrong("params->metric: features are for geodesic distances only");
        }
        if (part.mesh->dimension == 0) {
            return wrong("features need coordinates, which the mesh lacks");
        }
        const PreparedMesh& prepared = part.mesh->prepared;
        const auto features = Features::find(part.mesh->view(), prepared, degrees);
        GEODISK_TRY(features);
        GEODISK_TRY(check_params(prepared, part.params));
        if (corners != nullptr) {
            *corners = features->corners().size();
        }
        *domain = nullptr;
        if (!features->are_sampled(prepared, part.params)) {
            return Done{};
        }
        state->min_distance = given->min_distance;
        return keep(feature_domain(prepared, part.params, *features), state, domain);
    });
}

geodisk_status geodisk_domain_surfaces(const geodisk_surface_part* parts, size_t count,
                                       geodisk_domain** domain, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        if (count == 0) {
            return wrong("parts is empty");
        }
        const auto state = std::make_shared<DomainState>();
        state->parts.resize(count);
        std::vector<SurfacePart> surfaces;
        for (std::size_t i = 0; i < count; ++i) {
            const std::string name = "parts[" + std::to_string(i) + "]";
            const auto part =
                taken(parts != nullptr ? element_of(parts, i) : nullptr, name.c_str());
            GEODISK_TRY(part);
            const auto given = taken(part->params, (name + ".params").c_str());
            GEODISK_TRY(given);
            if (given->metric != GEODISK_GEODESIC) {
                return wrong(name + ": several surfaces take geodesic distances only");
            }
            Part& own = state->parts[i];
            if (const auto filled = fill(part->mesh, *given, own); !filled) {
                return wrong(name + ": " + filled.error().message);
            }
            surfaces.push_back(
                {&own.mesh->prepared, own.params, part->scale != 0 ? part->scale : 1});
        }
        state->min_distance = state->parts[0].params.min_distance;
        return keep(Domain::surfaces(surfaces), state, domain);
    });
}

geodisk_status geodisk_domain_box(const geodisk_box_params* params, geodisk_domain** domain,
                                  geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        const auto box = box_of(params);
        GEODISK_TRY(box);
        const auto state = std::make_shared<DomainState>();
        state->min_distance = box->min_distance;
        return keep(Domain::box(*box), state, domain);
    });
}

void geodisk_domain_release(geodisk_domain* domain) {
    delete domain;
}

geodisk_status geodisk_distance_for_count(const geodisk_mesh* mesh, const geodisk_radii* radii,
                                          const uint8_t* face_mask, double count, double* distance,
                                          geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || distance == nullptr) {
            return wrong("mesh or distance is NULL");
        }
        const PreparedMesh& prepared = mesh->shared->prepared;
        if (radii != nullptr && radii->shared->mesh != prepared.identity()) {
            return wrong("radii are of another mesh");
        }
        GEODISK_TRY(check_count(count));
        SampleParams params;
        params.min_distance = 1; // Is not looked at, but checked.
        params.radii = radii != nullptr ? &radii->shared->field : nullptr;
        if (face_mask != nullptr) {
            params.face_mask = {face_mask, prepared.face_count()};
        }
        GEODISK_TRY(check_params(prepared, params));
        *distance = distance_for_count(prepared, params, count);
        return Done{};
    });
}

geodisk_status geodisk_box_distance_for_count(const geodisk_box_params* params, double count,
                                              double* distance, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (distance == nullptr) {
            return wrong("distance is NULL");
        }
        auto box = box_of(params);
        GEODISK_TRY(box);
        GEODISK_TRY(check_count(count));
        const double found = distance_for_count(*box, count);
        box->min_distance = found; // Every other field was checked, so the distance is valid.
        box->darts = 1;
        GEODISK_TRY(pool_size(*box));
        *distance = found;
        return Done{};
    });
}

geodisk_status geodisk_level_count(const geodisk_mesh* mesh, const geodisk_surface_params* params,
                                   double factor, uint32_t* levels, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (levels == nullptr) {
            return wrong("levels is NULL");
        }
        Part part;
        GEODISK_TRY(fill_part(mesh, params, part));
        const PreparedMesh& prepared = part.mesh->prepared;
        GEODISK_TRY(check_params(prepared, part.params));
        const Levels found = levels_for(prepared, part.params, factor_of(factor));
        GEODISK_TRY(params_of_level(part.params, found, 0, {}));
        *levels = found.count;
        return Done{};
    });
}

geodisk_status geodisk_level_params(const geodisk_surface_params* params, double factor,
                                    uint32_t levels, uint32_t level, double* min_distance,
                                    uint64_t* seed, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (min_distance == nullptr || seed == nullptr) {
            return wrong("min_distance or seed is NULL");
        }
        const auto given = taken(params, "params");
        GEODISK_TRY(given);
        SampleParams last;
        last.min_distance = given->min_distance;
        last.seed = given->seed;
        last.darts = given->darts;
        const auto own = params_of_level(last, {levels, factor_of(factor)}, level, {});
        GEODISK_TRY(own);
        *min_distance = own->min_distance;
        *seed = own->seed;
        return Done{};
    });
}

} // extern "C"
