// The candidates of faces, drawn on the host as kernels draw them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <geodisk/checkpoint.hpp>
#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

#include "engine/domain/classes.hpp"
#include "engine/domain/placed_surface.hpp"

namespace geodisk {

/// Returns true if `a` comes before `b` in dart order. Among equal priorities, candidates are
/// ordered by face and weights, or by weights if faces have keys, as kernels do.
GEODISK_API bool is_before(const DrawnCandidate& a, const DrawnCandidate& b,
                           bool has_keys) noexcept;

/// Dart order of a job whose faces have keys, or have none.
struct DartOrder {
    bool has_keys = false;

    bool operator()(const DrawnCandidate& a, const DrawnCandidate& b) const {
        return is_before(a, b, has_keys);
    }
};

/// Draws the candidates of faces of a surface, or of a part of one in the frame of the whole: each
/// is the one that kernels draw, to the bit; a class is in the lowest bits of its priority. Without
/// shares of classes.
class GEODISK_API CandidateDraw {
  public:
    /// `mesh`, and what `params` refers to, must outlive it. The parameters fit the mesh and the
    /// frame.
    CandidateDraw(const PreparedMesh& mesh, const SampleParams& params, const JobFrame& frame);

    /// Returns the stages of the job.
    const Stages& stages() const noexcept { return surface_.stages; }

    /// Appends the candidates of a face in a stage, by number.
    void draw(std::uint32_t face, std::uint32_t stage, std::vector<DrawnCandidate>& out) const;

  private:
    PlacedSurface surface_;
    std::optional<ClassWords> classes_;
};

} // namespace geodisk
