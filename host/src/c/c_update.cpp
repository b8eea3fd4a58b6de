#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/job_frame.hpp>
#include <geodisk/update.hpp>

#include "c/c_call.hpp"
#include "c/c_domain.hpp"
#include "c/c_sampler.hpp"
#include "c/c_samples.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

/// Returns the state of a surface that can be updated.
Result<std::shared_ptr<const DomainState>> surface_of(const geodisk_mesh* mesh,
                                                      const geodisk_surface_params* params) {
    const auto state = std::make_shared<DomainState>();
    state->parts.resize(1);
    const auto given = fill_part(mesh, params, state->parts[0]);
    GEODISK_TRY(given);
    if (given->metric != GEODISK_GEODESIC) {
        return wrong("params->metric: updates are for geodesic distances only");
    }
    if (mesh->shared->dimension == 0) {
        return wrong("an update needs coordinates, which the mesh lacks");
    }
    state->min_distance = given->min_distance;
    return std::shared_ptr<const DomainState>(state);
}

SurfaceJob job_of(const DomainState& state) {
    return {state.parts[0].mesh->view(), state.parts[0].params};
}

/// Returns the frame given, or that of the surface.
Result<JobFrame> frame_for(const geodisk_job_frame* given, const DomainState& state) {
    if (given != nullptr) {
        return frame_from_bytes(std::as_bytes(std::span(given->bytes)));
    }
    return frame_of(state.parts[0].mesh->prepared, state.parts[0].params);
}

Result<Done> check_samples(const geodisk_surface_point* samples, std::size_t count,
                           geodisk_updater** updater) {
    if (updater == nullptr) {
        return wrong("updater is NULL");
    }
    if (samples == nullptr && count != 0) {
        return wrong("samples is NULL");
    }
    return Done{};
}

/// Adds the faces whose joined vertices differ: where a seam opens or closes, those on its other
/// side.
void add_rejoined(const Mesh& before, const Mesh& now, std::vector<std::uint32_t>& changed) {
    if (&before == &now || (before.joined.empty() && now.joined.empty())) {
        return;
    }
    const std::size_t count = std::min(before.triangles.size(), now.triangles.size());
    for (std::size_t h = 0; h < count; ++h) {
        if (before.triangles[h] != now.triangles[h]) {
            changed.push_back(static_cast<std::uint32_t>(h / 3));
        }
    }
}

geodisk_update_info info_of(const UpdateReport& report) {
    geodisk_update_info info{};
    info.rounds = report.rounds;
    info.faces = report.faces;
    info.uploaded = report.uploaded;
    info.removed = report.removed;
    info.added = report.added;
    info.disks = report.run.disks;
    return info;
}

} // namespace
} // namespace geodisk::c

struct geodisk_updater {
    geodisk::Updater updater;
    std::shared_ptr<const geodisk::c::DomainState> of; ///< The surface of the samples.
    geodisk::RunReport run{};                          ///< Report of the last update.
    std::atomic<bool> is_held = false;
};

using namespace geodisk;
using namespace geodisk::c;

namespace {

/// Runs `body()` unless another call uses the updater.
template <class Body>
Result<Done> with(geodisk_updater* updater, const Body& body) {
    return updater == nullptr ? Result<Done>(wrong("updater is NULL"))
                              : hold(updater->is_held, "the updater", body);
}

Result<Done> keep(Result<Updater> made, std::shared_ptr<const DomainState> of,
                  geodisk_updater** updater) {
    GEODISK_TRY(made);
    *updater = new geodisk_updater{std::move(*made), std::move(of)};
    return Done{};
}

} // namespace

extern "C" {

geodisk_status geodisk_updater_create(const geodisk_mesh* mesh,
                                      const geodisk_surface_params* params,
                                      const geodisk_job_frame* frame,
                                      const geodisk_surface_point* samples, size_t sample_count,
                                      geodisk_updater** updater, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        GEODISK_TRY(check_samples(samples, sample_count, updater));
        const auto of = c::surface_of(mesh, params);
        GEODISK_TRY(of);
        const auto used = frame_for(frame, **of);
        GEODISK_TRY(used);
        const SurfaceJob job = job_of(**of);
        return keep(Updater::create(job.mesh, job.params, *used, samples_of(samples, sample_count)),
                    *of, updater);
    });
}

geodisk_status
geodisk_updater_create_edited(const geodisk_mesh* mesh_before,
                              const geodisk_surface_params* params_before, const geodisk_mesh* mesh,
                              const geodisk_surface_params* params, const geodisk_job_frame* frame,
                              const geodisk_surface_point* samples, size_t sample_count,
                              geodisk_updater** updater, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        GEODISK_TRY(check_samples(samples, sample_count, updater));
        const auto before = c::surface_of(mesh_before, params_before);
        GEODISK_TRY(before);
        const auto after = c::surface_of(mesh, params);
        GEODISK_TRY(after);
        const auto used = frame_for(frame, **before);
        GEODISK_TRY(used);
        return keep(Updater::create(job_of(**before), job_of(**after), *used,
                                    samples_of(samples, sample_count)),
                    *after, updater);
    });
}

geodisk_status geodisk_update(geodisk_updater* updater, geodisk_sampler* sampler,
                              const geodisk_mesh* mesh, const geodisk_surface_params* params,
                              const uint32_t* changed, size_t changed_count,
                              geodisk_progress_fn progress, void* user, geodisk_update_info* info,
                              geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        return with(updater, [&]() -> Result<Done> {
            if (changed == nullptr && changed_count != 0) {
                return wrong("changed is NULL");
            }
            if (info != nullptr) { // Before the work.
                GEODISK_TRY(give(info, "info", geodisk_update_info{}));
            }
            const auto of = c::surface_of(mesh, params);
            GEODISK_TRY(of);
            std::vector<std::uint32_t> faces(changed, changed + changed_count);
            add_rejoined(*updater->of->parts[0].mesh, *(*of)->parts[0].mesh, faces);
            const auto report = search(state, progress, user, [&](const ProgressCallback& heard) {
                const SurfaceJob job = job_of(**of);
                return updater->updater.update(state.runner, job.mesh, job.params, faces, heard);
            });
            GEODISK_TRY(report);
            updater->of = *of;
            updater->run = report->run;
            return info == nullptr ? Result<Done>(Done{}) : give(info, "info", info_of(*report));
        });
    });
}

geodisk_status geodisk_updater_samples(geodisk_updater* updater, geodisk_samples** samples,
                                       geodisk_error* error) {
    return answer(error, [&] {
        return with(updater, [&]() -> Result<Done> {
            if (samples == nullptr) {
                return wrong("samples is NULL");
            }
            SampleSet set;
            const auto found = updater->updater.samples();
            set.samples.assign(found.begin(), found.end());
            set.existing = updater->updater.existing();
            set.report = updater->run;
            *samples = new geodisk_samples{updater->of, std::move(set)};
            return Done{};
        });
    });
}

geodisk_status geodisk_updater_frame(geodisk_updater* updater, geodisk_job_frame* frame,
                                     geodisk_error* error) {
    return answer(error, [&] {
        return with(updater, [&]() -> Result<Done> {
            if (frame == nullptr) {
                return wrong("frame is NULL");
            }
            const auto bytes = to_bytes(updater->updater.frame());
            std::memcpy(frame->bytes, bytes.data(), bytes.size());
            return Done{};
        });
    });
}

void geodisk_updater_release(geodisk_updater* updater) {
    delete updater;
}

} // extern "C"
