// Work on one surface by many processes, by MPI.
// Experimental.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <mpi.h>

#include <geodisk/checkpoint.hpp>
#include <geodisk/exchange.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mesh_range.hpp>
#include <geodisk/params.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Samples a surface by all processes of a communicator, which all call it. Process 0 gives the
/// mesh and the parameters; on the others both are null. It divides the surface and sends each
/// process its part. The samples do not depend on the number of processes, nor on their devices;
/// see host/docs/mpi.md. MPI must be initialized; messages are sent by the calling thread, on a
/// duplicate of the communicator. METIS handles SIGTERM and SIGABRT while process 0 divides the
/// surface: block SIGTERM in its other threads, if it has any.
///
/// Each process has a runner of its own. `progress` is called on each with its own work, also while
/// it waits for others; the numbers are those of its part.
///
/// Errors: the same on all processes, naming the process that failed: those of
/// Runner::sample_and_wait(); `invalid_argument` for more processes than faces, for classes
/// and maximal sets. `cancelled` if `progress` returns false while waiting: the
/// process then no longer takes part, so end the others, as MPI_Abort() does. So do for
/// `out_of_host_memory` without the name of a process: it came between messages, for which others
/// wait.
Result<SharedSamples> sample_together(MPI_Comm communicator, Runner& runner,
                                      const PreparedMesh* mesh, const SampleParams* params,
                                      const ProgressCallback& progress = {}) noexcept;

/// How a process waits for the others, and ends them.
struct ProcessOptions {
    /// Is asked while the process waits. Returns false to stop with `cancelled`; null waits on.
    std::function<bool()> goes_on;
    /// Ends all processes by an error of which the others do not learn, as MPI_Abort() does. It is
    /// called by any thread and does not return. Null returns the error instead, to this process
    /// alone; surfaces that are read in ranges need it.
    std::function<void(const Error&)> ends_all;
};

/// Faces by the places of their vertices, three vertices for each face.
struct PlacedFaces {
    std::vector<double> positions;        ///< Three coordinates per vertex.
    std::vector<std::uint32_t> triangles; ///< Three vertices per face.
    std::optional<RadiusField> radii;     ///< Factors on the faces; none if radii do not vary.
};

/// A surface that all processes read in ranges: none holds the whole. A process may hold several
/// parts of it, the mesh of one at a time. All processes make the same calls.
class SharedSurface {
  public:
    /// Reads the range of one part. It is called once per part of a process, on a thread of its
    /// own, with messages among all parts, which count as processes here. Its errors are the same
    /// for all parts.
    using ReadRange = std::function<Result<MeshRange>(Exchange& parts)>;

    /// Maximum number of parts per process.
    static constexpr std::uint32_t kMaxParts = 128;

    SharedSurface(SharedSurface&&) noexcept;
    SharedSurface& operator=(SharedSurface&&) noexcept;
    ~SharedSurface();

    // Properties of the whole, the same on all processes.

    const RangedStatistics& statistics() const noexcept;
    /// Returns a mesh without faces, with the statistics of the whole.
    const PreparedMesh& outline() const noexcept;
    /// Returns radii without faces, with bounds and sums of the whole; null if they do not vary.
    const RadiusField* radii() const noexcept;
    /// Returns the frame of a job on the surface. The parameters are of seed, distance and
    /// candidates alone; the surface itself has radii and the mask. Errors: `mesh_rejected` if the
    /// job needs the whole; those of frame_of().
    Result<JobFrame> frame(const SampleParams& params) const noexcept;

    /// Samples the surface. All processes give the same parameters, as for frame(). `checkpoints`
    /// is null on all but process 0, or for a job without any. Errors: those of frame() and of
    /// Processes::sample().
    Result<SharedSamples> sample(Runner& runner, const SampleParams& params,
                                 const Checkpoints* checkpoints,
                                 const ProgressCallback& progress) noexcept;

    /// Returns the places of some faces and their radii, all at one process and nothing elsewhere.
    /// All processes give the same faces, in ascending order.
    Result<PlacedFaces> places(std::span<const std::uint32_t> faces,
                               std::uint32_t process) noexcept;

  private:
    friend class Processes;
    struct Impl;
    explicit SharedSurface(std::unique_ptr<Impl> impl) noexcept;

    std::unique_ptr<Impl> impl_;
};

/// The processes of a communicator. All make the same calls, each by one thread at a time.
class Processes {
  public:
    /// MPI must be initialized. Messages are sent on duplicates of the communicator.
    static Result<Processes> create(MPI_Comm communicator, ProcessOptions options) noexcept;

    /// Returns messages among the processes.
    Exchange& exchange() const noexcept { return *exchange_; }

    /// Samples a surface as sample_together() does. `checkpoints` is null on all but process 0, or
    /// for a job without any.
    Result<SharedSamples> sample(Runner& runner, const PreparedMesh* mesh,
                                 const SampleParams* params, const Checkpoints* checkpoints,
                                 const ProgressCallback& progress) const noexcept;

    /// Returns the number of parts of each process for a mesh of so many faces: as many as wanted,
    /// or as memory suggests if that is 0. Several need MPI_THREAD_SERIALIZED.
    std::uint32_t parts_for(std::uint64_t faces, std::uint32_t wanted) const noexcept;

    /// Reads a surface in ranges. All processes give the same number of parts. Errors, the same on
    /// all processes: those of `read`; `mesh_rejected` for a mesh that has to be read as a whole,
    /// with the reason.
    Result<SharedSurface> read_ranges(std::uint32_t parts,
                                      const SharedSurface::ReadRange& read) const noexcept;

  private:
    Processes(MPI_Comm communicator, ProcessOptions options, std::unique_ptr<Exchange> exchange);

    MPI_Comm communicator_;
    ProcessOptions options_;
    std::unique_ptr<Exchange> exchange_;
};

/// Returns the process of each face, so that all have about the same work and short borders. `work`
/// is that of each face; it sums to 1. Each process has a face. Errors: `invalid_argument` for more
/// processes than faces.
Result<std::vector<std::uint32_t>> divide_faces(const PreparedMesh& mesh,
                                                std::span<const double> work,
                                                std::uint32_t processes) noexcept;

/// Returns the faces that are marked, and at least all that a path of length `reach` from them can
/// lead to, in ascending order.
Result<std::vector<std::uint32_t>> faces_within(const PreparedMesh& mesh,
                                                std::span<const std::uint8_t> is_marked,
                                                double reach) noexcept;

} // namespace geodisk
