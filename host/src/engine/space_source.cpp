#include "engine/space_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "bindings.h"
#include "engine/device_mesh.hpp"
#include "engine/plan.hpp"

namespace geodisk {
namespace {

// Of a disk's candidates by area: several sheets may pass through one.
constexpr double kInDisk = 80.0 / 20;

using Vector = std::array<double, 3>;

/// Normal of a face, of twice its area in length.
Vector face_normal(const MeshView& view, std::size_t face) {
    std::array<Vector, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = std::size_t{3} * view.triangles[3 * face + k];
        corners[k] = {view.positions[at], view.positions[at + 1], view.positions[at + 2]};
    }
    Vector u, v;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        u[axis] = corners[1][axis] - corners[0][axis];
        v[axis] = corners[2][axis] - corners[0][axis];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Of unit length, weighted by the areas of the faces; zero where those cancel out.
std::vector<std::array<float, 3>> vertex_normals(const MeshView& view) {
    std::vector<Vector> sums(view.positions.size() / 3, Vector{});
    for (std::size_t corner = 0; corner < view.triangles.size(); ++corner) {
        const Vector normal = face_normal(view, corner / 3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sums[view.triangles[corner]][axis] += normal[axis];
        }
    }
    std::vector<std::array<float, 3>> normals;
    normals.reserve(sums.size());
    for (const Vector& n : sums) {
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        std::array<float, 3> unit{};
        for (std::size_t axis = 0; axis < 3 && length > 0; ++axis) {
            // What is too small to be told from zero is zero, against denormal numbers.
            const double part = n[axis] / length;
            unit[axis] = static_cast<float>(std::abs(part) < 0x1p-40 ? 0.0 : part);
        }
        normals.push_back(unit);
    }
    return normals;
}

} // namespace

SpaceFrame::SpaceFrame(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params)
    : normals(vertex_normals(view)) {
    box.min_distance = params.min_distance;
    box.seed = params.seed;
    // Of darts, too.
    const Stages stages = stages_of(mesh, params);
    box.pool_ratio = stages.candidates() / std::max(1.0, stages.samples);
    box.extents.assign(3, 0);
    vertices.resize(view.positions.size() / 3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        // Corners of faces alone: a vertex without faces may be anywhere.
        for (const std::uint32_t v : view.triangles) {
            const double x = view.positions[std::size_t{3} * v + axis];
            least = std::min(least, x);
            most = std::max(most, x);
        }
        // A flat surface is given some thickness; the farthest vertices lie inside.
        double& side = box.extents[axis];
        side = std::max((most - least) * (1 + 0x1p-30), 0x1p-10 * params.min_distance);
        for (const std::uint32_t v : view.triangles) {
            const double x = view.positions[std::size_t{3} * v + axis];
            vertices[v][axis] = static_cast<std::uint32_t>((x - least) / side * 0x1p32);
        }
    }
}

double SpaceFrame::guard() const {
    // Coordinates of two candidates are each less than two units too small, so their difference is
    // off by less than two, and a distance by twice that at most.
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    return kBoxGuard + 0x1p-30 * longest / box.min_distance;
}

SpaceSource::SpaceSource(const Sampler::Impl& sampler, const MeshView& view,
                         const PreparedMesh& mesh, const SampleParams& params, SpaceFrame frame,
                         VkDeviceSize memory)
    : BoxSource(sampler, frame.box, memory,
                {sampler.takes_curves ? 6u : 3u, // Normals as well.
                 kInDisk * frame.box.pool_ratio, frame.guard(), finest_axes(frame.box),
                 stages_of(mesh, params), samples_per_area(), params.stop_count}),
      view_(view), mesh_(mesh), params_(params), frame_(std::move(frame)) {}

std::size_t SpaceSource::corner_bytes() const {
    return std::size_t{mesh_.face_count()} * gpu::kSpaceRows * 16;
}

Result<WorkspaceNeeds> SpaceSource::needs(const RunPlan& plan) const {
    auto needs = BoxSource::needs(plan);
    if (!needs) {
        return needs;
    }
    needs->bytes[gpu::kBindFaces] = corner_bytes();
    const std::string what = "for " + std::to_string(capacity(plan)) + " candidates and " +
                             std::to_string(mesh_.face_count()) + " faces in space";
    if (auto checked = check_needs(*needs, what, sampler_.report); !checked) {
        return checked.error();
    }
    return needs;
}

Result<std::vector<std::byte>> SpaceSource::bytes(BufferRole role) const {
    if (role == BufferRole::faces) {
        std::vector<std::byte> bytes(corner_bytes());
        for (std::size_t corner = 0; corner < view_.triangles.size(); ++corner) {
            const std::uint32_t vertex = view_.triangles[corner];
            const std::size_t row = corner / 3 * gpu::kSpaceRows + corner % 3;
            std::memcpy(bytes.data() + row * 16, frame_.vertices[vertex].data(), 12);
            std::memcpy(bytes.data() + (row + 3) * 16, frame_.normals[vertex].data(), 12);
        }
        const double unit = working_distance(mesh_, params_);
        for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
            std::byte* const row = bytes.data() + std::size_t{face} * gpu::kSpaceRows * 16;
            const float area = face_area(mesh_, face, unit);
            const std::uint32_t key = params_.face_keys.empty() ? face : params_.face_keys[face];
            std::memcpy(row + 12, &area, 4);
            std::memcpy(row + 28, &key, 4);
        }
        return bytes;
    }
    return BoxSource::bytes(role);
}

} // namespace geodisk
