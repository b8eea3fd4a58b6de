#include "geodisk/feature_run.hpp"

#include <algorithm>
#include <utility>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns how many corners have a face that takes samples.
std::size_t sampled_corners(const Features& features, const MeshInput& mesh) {
    const auto takes_samples = [&](std::uint32_t corner) {
        return mesh.face_mask.empty() || mesh.face_mask[corner / 3] != 0;
    };
    const auto is_sampled = [&](std::uint32_t vertex) {
        const VertexFan& fan = mesh.prepared.fans()[vertex];
        return std::ranges::any_of(
            mesh.prepared.corners().subspan(fan.first_corner, fan.corner_count), takes_samples);
    };
    return static_cast<std::size_t>(std::ranges::count_if(features.corners(), is_sampled));
}

} // namespace

FeatureRun::FeatureRun(const SampleJob& job, const MeshInput& mesh) : mesh_(mesh) {
    if (!job.features) {
        return;
    }
    if (mesh.dimension() == 0) {
        fail_usage("--features needs the coordinates of the mesh, and it has edge lengths alone");
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    features_ = take(Features::find(view, mesh.prepared, *job.features));
    is_sampled_ = features_->are_sampled(mesh.prepared, mesh.with_fields({}));
    corners_ = sampled_corners(*features_, mesh);
}

std::vector<Sample> FeatureRun::settle(const SampleParams& params, RunDevice& device,
                                       ProgressLine& progress) {
    if (!is_sampled_) {
        return {params.given.begin(), params.given.end()};
    }
    SampleParams own = params;
    own.throws = 0;
    own.stop_count = 0;
    const auto task_at = [&](double) {
        Domain domain = take(feature_domain(mesh_.prepared, own, *features_));
        const double expected = static_cast<double>(own.given.size() + corners_) +
                                0.75 * features_->length() / own.min_distance;
        return Task{std::move(domain), expected};
    };
    DeviceResult result = device.run(task_at, own.min_distance, {}, progress);
    done_.open_seconds += result.done.open_seconds;
    done_.compile_seconds += result.done.compile_seconds;
    done_.run.seconds.compile += result.done.run.seconds.compile;
    done_.run.seconds.upload += result.done.run.seconds.upload;
    done_.run.seconds.sample += result.done.run.seconds.sample;
    done_.run.seconds.readback += result.done.run.seconds.readback;
    return std::move(result.set.samples);
}

void FeatureRun::add_seconds(DeviceRun& done) const {
    done.open_seconds += done_.open_seconds;
    done.compile_seconds += done_.compile_seconds;
    done.run.seconds.compile += done_.run.seconds.compile;
    done.run.seconds.upload += done_.run.seconds.upload;
    done.run.seconds.sample += done_.run.seconds.sample;
    done.run.seconds.readback += done_.run.seconds.readback;
}

std::vector<std::uint32_t> feature_kinds(std::span<const Sample> samples, std::size_t given,
                                         std::size_t settled) {
    std::vector<std::uint32_t> kinds(samples.size(), 0);
    for (std::size_t i = given; i < std::min(settled, samples.size()); ++i) {
        kinds[i] = static_cast<std::uint32_t>(feature_of(samples[i]));
    }
    return kinds;
}

} // namespace geodisk::tools
