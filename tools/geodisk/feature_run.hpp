// Samples on the corners and curves of a mesh, before those on its faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/features.hpp>

#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// The features of a job on its mesh, none unless it asks for them.
class FeatureRun {
  public:
    /// Finds the features. Throws UserError for a mesh without coordinates.
    FeatureRun(const SampleJob& job, const MeshInput& mesh);

    /// Returns the given samples of `params`, and behind them those on features at its distance.
    std::vector<Sample> settle(const SampleParams& params, RunDevice& device,
                               ProgressLine& progress);
    /// Adds what all settle() took to the times of a run.
    void add_seconds(DeviceRun& done) const;

    /// Returns true if the job asks for features and there are none.
    bool are_missing() const { return features_ && !is_sampled_; }
    /// Returns the number of corners on faces that take samples.
    std::size_t corners() const { return corners_; }
    /// Returns the length of all curves.
    double length() const { return features_ ? features_->length() : 0; }

  private:
    const MeshInput& mesh_;
    std::optional<Features> features_;
    bool is_sampled_ = false;
    std::size_t corners_ = 0;
    DeviceRun done_;
};

/// Returns the FeatureKind of each sample: of `given` samples up to `settled` by their places.
std::vector<std::uint32_t> feature_kinds(std::span<const Sample> samples, std::size_t given,
                                         std::size_t settled);

} // namespace geodisk::tools
