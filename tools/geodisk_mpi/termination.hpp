// SIGTERM, by which mpirun ends the processes of a run.
#pragma once

namespace geodisk::tools {

/// Receives SIGTERM on a thread of its own from now on, which does what the program's handler does.
/// Threads that are made later never get it. METIS replaces the handler while it divides a surface,
/// and must not be interrupted. Call it before any other thread is made.
void receive_termination();

} // namespace geodisk::tools
