// Updater: samples of a surface that follow its edits.
// Experimental.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh_view.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>

namespace geodisk {

/// Statistics of an update.
struct UpdateReport {
    /// Number of regions decided. Each is wider than the last. 1 if the whole surface was decided.
    std::uint32_t rounds = 0;
    std::uint32_t faces = 0;    ///< Faces of the last region.
    std::uint32_t uploaded = 0; ///< Faces of the part that was on the device for it.
    std::uint32_t removed = 0;  ///< Number of samples removed, without existing ones.
    std::uint32_t added = 0;    ///< Number of new samples.
    RunReport run;              ///< Work on the device, in all rounds.
};

/// A surface with the parameters of its job.
struct SurfaceJob {
    MeshView mesh;
    SampleParams params;
};

/// Returns the frame in which an edited surface is sampled, where `frame` is that of the surface
/// before. The result decides alike if the edited surface fits: its longest edge is not longer, up
/// to whole distances, and it has no first edge of more than two faces. Otherwise the result is
/// frame_of() the edited surface. Errors: those of frame_of().
GEODISK_API Result<JobFrame> frame_for_edit(const JobFrame& frame, const PreparedMesh& edited,
                                            const SampleParams& params) noexcept;

/// The samples of a pool on a surface, kept up to date while the surface is edited. An update
/// decides only what the edit can reach, and takes time in proportion to the edit. If the edited
/// surface does not fit the frame, the update decides all candidates in frame_for_edit().
///
/// The samples are always those of a whole run in the same frame: Domain::surface(mesh, params,
/// frame()). See host/docs/update.md. Not thread-safe.
class GEODISK_API Updater {
  public:
    /// Makes the updater of a surface and its samples, as Runner returned them: the existing ones
    /// of `params` first. Copies what it needs. Takes time linear in the mesh. `frame` is the one
    /// in which the samples were decided: frame_of() this surface, unless Domain::surface() was
    /// given another frame, or another updater made the samples.
    ///
    /// Errors: `invalid_argument` for parameters that cannot be updated: darts, a stop count,
    /// classes or a maximal set; for a frame of another job; for a minimum
    /// distance that exceeds the surface; for a sample that is neither an existing one nor a
    /// candidate of this mesh, seed, distance and pool ratio, with its index in Error::element;
    /// `mesh_rejected` as PreparedMesh::prepare().
    static Result<Updater> create(const MeshView& mesh, const SampleParams& params,
                                  const JobFrame& frame, std::span<const Sample> samples,
                                  const ThreadOptions& threads = {}) noexcept;
    /// Makes the updater of an edited surface from the samples of the surface before, whose faces
    /// may have other numbers. Finds out what has changed; call update() with `after` next, and no
    /// changed faces. Faces correspond by their keys, or by their numbers without. `frame` is the
    /// one in which the samples on `before` were decided. Takes time linear in both meshes.
    ///
    /// Errors: those of create() and update().
    static Result<Updater> create(const SurfaceJob& before, const SurfaceJob& after,
                                  const JobFrame& frame, std::span<const Sample> samples,
                                  const ThreadOptions& threads = {}) noexcept;
    Updater(Updater&&) noexcept;
    Updater& operator=(Updater&&) noexcept;
    ~Updater();

    /// Brings the samples up to date with an edited surface. `changed` lists all faces with
    /// any change: corner positions, vertices, radii, key or mask. Other faces must be as before
    /// and are not read. Faces keep their numbers: to remove one, let it name a vertex twice.
    /// Number new faces after the last, and list them as changed. Joining seams reads all faces and
    /// takes time linear in the mesh; to avoid that, join them before, and set MeshView::keep_seams
    /// in all views.
    /// Existing samples and points to avoid are compared with those before.
    ///
    /// Errors: `invalid_argument` for another seed, distance or pool ratio, parameters that cannot
    /// be updated, fewer faces than before, and a changed face that does not exist; those of
    /// Domain::surface() and PreparedMesh::prepare(); those of Runner::sample_and_wait(), to which
    /// `progress` goes. The samples then stay as they were, and the next update includes this edit.
    Result<UpdateReport> update(Runner& runner, const MeshView& mesh, const SampleParams& params,
                                std::span<const std::uint32_t> changed,
                                const ProgressCallback& progress = {}) noexcept;

    /// Returns the samples in dart order, the existing ones first.
    std::span<const Sample> samples() const noexcept;
    /// Returns the number of existing samples.
    std::size_t existing() const noexcept;
    /// Returns the frame of the samples. Its longest edge is rounded up as far as this changes no
    /// decision.
    const JobFrame& frame() const noexcept;

    struct Impl; ///< Internal.

  private:
    explicit Updater(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

} // namespace geodisk
