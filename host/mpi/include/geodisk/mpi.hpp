// Sampling one surface by many processes, by MPI.
// Experimental.
#pragma once

#include <vector>

#include <mpi.h>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/process_report.hpp>
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

} // namespace geodisk
