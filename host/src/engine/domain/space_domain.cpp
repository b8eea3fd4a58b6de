#include "engine/domain/space_domain.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "bindings.h"
#include "engine/capacity.hpp"
#include "engine/domain/device_mesh.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/domain/tolerances.hpp"
#include "engine/request/check_fields.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Candidates in a disk per candidate and sample of a full surface: several sheets may pass through
// one disk.
constexpr double kCrowd = 4;
// Reached for a box of a million distances.
constexpr double kWidestGuard = 0x1p-10;

using Vector = std::array<double, 3>;

/// Returns the normal of a face; its length is twice the area.
Vector face_normal(const MeshView& view, std::size_t face) {
    std::array<Vector, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = view.triangles[3 * face + k];
        corners[k] = {view.coordinate(v, 0), view.coordinate(v, 1), view.coordinate(v, 2)};
    }
    Vector u, v;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        u[axis] = corners[1][axis] - corners[0][axis];
        v[axis] = corners[2][axis] - corners[0][axis];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Returns unit normals, weighted by the areas of the faces; zero where those cancel out. Vertices
/// that the mesh joined have the same one.
std::vector<std::array<float, 3>> vertex_normals(const MeshView& view, const PreparedMesh& mesh) {
    const auto joined = mesh.joined_vertices();
    const auto place_of = [&](std::size_t v) { return joined.empty() ? v : joined[v]; };
    std::vector<Vector> sums(view.vertex_count(), Vector{});
    for (std::size_t corner = 0; corner < view.triangles.size(); ++corner) {
        const Vector normal = face_normal(view, corner / 3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sums[place_of(view.triangles[corner])][axis] += normal[axis];
        }
    }
    std::vector<std::array<float, 3>> normals;
    normals.reserve(sums.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const Vector& n = sums[place_of(v)];
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        std::array<float, 3> unit{};
        for (std::size_t axis = 0; axis < 3 && length > 0; ++axis) {
            // Tiny parts become zero, against denormal numbers.
            const double part = n[axis] / length;
            unit[axis] = static_cast<float>(std::abs(part) < 0x1p-40 ? 0.0 : part);
        }
        normals.push_back(unit);
    }
    return normals;
}

Result<Done> check_view(const MeshView& view, const PreparedMesh& mesh) {
    if (view.dimension != 3) {
        return Error{Status::invalid_argument,
                     "straight-line distances need three coordinates per vertex, not " +
                         std::to_string(view.dimension)};
    }
    if (view.face_count() != mesh.face_count() || view.vertex_count() != mesh.vertex_count()) {
        return Error{Status::invalid_argument, "the view is not of the mesh that was prepared"};
    }
    return Done{};
}

} // namespace

SpaceFrame::SpaceFrame(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params)
    : normals(vertex_normals(view, mesh)) {
    box.min_distance = params.min_distance;
    box.seed = params.seed;
    box.extents.assign(3, 0);
    vertices.resize(view.vertex_count());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        // Only corners of faces: an unused vertex may be anywhere.
        for (std::size_t corner = 0; corner < view.triangles.size(); ++corner) {
            const double x = view.coordinate(view.triangles[corner], axis);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        // Give a flat surface some thickness; the farthest vertices lie inside.
        double& side = box.extents[axis];
        side = std::max((most - least) * (1 + 0x1p-30), 0x1p-10 * params.min_distance);
        for (std::size_t corner = 0; corner < view.triangles.size(); ++corner) {
            const std::uint32_t v = view.triangles[corner];
            const double x = view.coordinate(v, axis);
            vertices[v][axis] = static_cast<std::uint32_t>((x - least) / side * 0x1p32);
        }
    }
}

double SpaceFrame::guard() const {
    // The coordinates of a candidate are less than two units too small. Their difference is
    // therefore off by less than two, and a distance by at most twice that.
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    return kBoxGuard + 0x1p-30 * longest / box.min_distance;
}

Result<Domain> Domain::surface_in_space(const MeshView& view, const PreparedMesh& mesh,
                                        const SampleParams& params, Metric metric) noexcept {
    return guarded([&]() -> Result<Domain> {
        GEODISK_TRY(pool_size(mesh, params));
        GEODISK_TRY(check_fields(params, RequestField::metric));
        GEODISK_TRY(check_view(view, mesh));
        SpaceFrame frame(view, mesh, params);
        if (!(frame.guard() <= kWidestGuard)) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small beside the bounding box of the mesh"};
        }
        return Domain(std::make_unique<SpaceDomain>(view, mesh, params, metric, std::move(frame)));
    });
}

SpaceDomain::SpaceDomain(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params,
                         Metric metric, SpaceFrame frame)
    : GridDomain(frame.box, finest_axes(frame.box),
                 metric == Metric::approximate ? 6 : 3, // With normals.
                 kCrowd, frame.guard()),
      view_(view), mesh_(mesh), params_(params), frame_(std::move(frame)) {
    kernels.domain = DomainKind::space;
    kernels.curved = metric == Metric::approximate;
    stages = stages_of(mesh, params);
    samples_per_measure = samples_per_area();
    samples = samples_to_expect(stages.samples, params.darts, params.stop_count);
    stop_count = params.stop_count;
    units = mesh.face_count();
    first_faces = {0, mesh.face_count()};
    add_existing(params, 0, settled);
}

void SpaceDomain::add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                            const RunPlan& plan) const {
    GridDomain::add_needs(needs, candidates, plan);
    needs.bytes[gpu::kBindFaces] = upload_size(BufferRole::corners);
}

std::string SpaceDomain::beside_candidates() const {
    return " and " + std::to_string(mesh_.face_count()) + " faces in space";
}

void SpaceDomain::set_constants(gpu::JobRec& job, const RunPlan& plan) const {
    GridDomain::set_constants(job, plan);
    job.has_keys = params_.face_keys.empty() ? 0 : 1;
}

std::size_t SpaceDomain::upload_size(BufferRole role) const {
    switch (role) {
    case BufferRole::corners:
        return std::size_t{mesh_.face_count()} * gpu::kSpaceRows * 16;
    case BufferRole::samples:
        return settled.size() * sizeof settled[0];
    default:
        return GridDomain::upload_size(role);
    }
}

Result<UploadParts> SpaceDomain::upload_parts(const RunPlan& plan, BufferRole role) const {
    if (role == BufferRole::samples) {
        return UploadParts{upload_part(std::span(settled))};
    }
    if (role != BufferRole::corners) {
        return GridDomain::upload_parts(plan, role);
    }
    constexpr std::size_t kRow = 16, kFaceBytes = gpu::kSpaceRows * kRow;
    const double unit = working_distance(mesh_, params_);
    const auto write = [this, unit](std::size_t begin, std::size_t end, std::byte* out) {
        std::memset(out, 0, (end - begin) * kFaceBytes);
        for (std::size_t face = begin; face < end; ++face, out += kFaceBytes) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = view_.triangles[3 * face + corner];
                std::byte* const row = out + corner * kRow;
                std::memcpy(row, frame_.vertices[vertex].data(), 12);
                std::memcpy(row + 3 * kRow, frame_.normals[vertex].data(), 12);
            }
            const auto own = static_cast<std::uint32_t>(face);
            const float area = takes_samples(params_, own) ? face_area(mesh_, own, unit) : 0;
            const std::uint32_t key = params_.face_keys.empty() ? own : params_.face_keys[face];
            std::memcpy(out + 12, &area, 4);
            std::memcpy(out + 28, &key, 4);
        }
    };
    return UploadParts{{kFaceBytes, mesh_.face_count(), write}};
}

} // namespace geodisk
