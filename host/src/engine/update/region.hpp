// Decides the candidates around an edit again, as far as the edit reaches.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <geodisk/job_frame.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/update.hpp>

#include "engine/update/dart_set.hpp"
#include "engine/update/face_reach.hpp"
#include "engine/update/live_mesh.hpp"
#include "engine/update/mesh_part.hpp"

namespace geodisk {

/// The edited surface, with its samples before the edit.
struct EditedSurface {
    const MeshView& mesh;
    const SampleParams& params;
    const JobFrame& frame;
    const LiveMesh& faces;
    const DartSet& darts;
    double old_factor; ///< Largest radius factor before the edit on faces that have changed, or 0.
    const ThreadOptions& threads;
    const ProgressCallback& progress;
};

/// Returns the largest radius factor on a face.
float largest_factor(const RadiusField& radii, std::uint32_t face);

/// Samples that an edit removes and adds, both in dart order.
struct Changes {
    Darts removed, added;
};

/// Returns what turns some samples into others, both in dart order.
Changes changes_between(const Darts& old, const Darts& now, bool has_keys);

/// Finds the samples that an edit changes (host/docs/update.md). A region around the edit is
/// decided again, with the samples outside it as they are. If what changes in it reaches out of it,
/// it becomes wider.
class Region {
  public:
    Region(Runner& runner, const EditedSurface& surface);

    /// Returns the changes, where `sources` are faces that have changed or share a vertex with one
    /// that has. Disks of points to avoid that are no longer there, or new, reach `avoided` from
    /// them.
    Result<Changes> decide(std::span<const std::uint32_t> sources, double avoided,
                           UpdateReport& report);

  private:
    /// Returns the distance within which candidates with these radius factors may conflict.
    double reach_of(double factor, double other) const;
    /// Adds to the region what is within some reaches of where changes go on, or within `least`.
    void widen(double reaches, double least);
    /// Makes `reach_` what the region needs. Returns true if that is more than it was.
    bool raise_reach();
    /// Returns the points to avoid whose disks may meet some faces.
    std::vector<KeepOut> avoided_near(std::span<const std::uint32_t> faces);
    /// A candidate of the region, or a sample outside it, by its face in the part.
    struct Entry {
        DrawnCandidate dart;
        bool is_inside;
    };
    /// Prepares the region with the faces around it.
    Result<MeshPart> prepare_part();
    /// Returns the candidates of the region and the samples near it, in dart order.
    std::vector<Entry> list(const MeshPart& part) const;
    /// Returns which of them are accepted.
    Result<std::vector<bool>> accept(const MeshPart& part, const std::vector<Entry>& entries,
                                     UpdateReport& report);
    /// Returns the changes in the region, and collects the samples from which they go on.
    Changes compare(const MeshPart& part, const std::vector<Entry>& entries,
                    const std::vector<bool>& accepted);

    Runner& runner_;
    EditedSurface surface_;
    double margin_; ///< Of distances to faces, in minimum distances; 0 where radii do not vary.
    /// More than candidates that conflict are apart, if one of them is in the region.
    double reach_;
    FaceReach faces_;
    FaceSet region_, ring_, all_, near_;
    std::vector<KeepOut> avoided_;       ///< Those whose disks may meet the region.
    std::vector<std::uint32_t> goes_on_; ///< Faces from which changes leave the region.
    std::unordered_map<std::uint32_t, std::vector<Sample>> given_; ///< By face.
};

} // namespace geodisk
