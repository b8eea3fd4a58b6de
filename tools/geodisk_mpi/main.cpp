// The program `geodisk_mpi`: one surface by many processes. The first one is the program; the
// others help it, and say nothing.
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <mpi.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <geodisk/version.hpp>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "program/failure.hpp"
#include "program/program.hpp"
#include "program/utf8_arguments.hpp"
#include "sample_command.hpp"
#include "session.hpp"
#include "termination.hpp"
#include "verify_command.hpp"

namespace {

using geodisk::tools::Command;
using geodisk::tools::Session;

constexpr const char* kExamples[] = {
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.ply --count 10000",
    "mpirun -n 4 geodisk_mpi verify bunny.obj points.ply",
};

Session* session = nullptr;

void set_up(Command app) {
    app.has_version("geodisk_mpi " GEODISK_VERSION_STRING);
    app.needs_command();
    app.has_footer(geodisk::tools::help_footer(kExamples));
    geodisk::tools::add_shared_sample_command(app, *session);
    geodisk::tools::add_shared_verify_command(app, *session);
    if (session->is_first()) { // Which alone prints and writes.
        geodisk::tools::add_completion_command(app);
        geodisk::tools::add_manual_command(app);
    }
}

void check_alike(Command, std::vector<std::string>& arguments) {
    session->check_arguments(arguments);
}

/// The work of all but the first process, which tells of all errors.
void help(int argc, char** argv) {
    std::vector<std::string> arguments = geodisk::tools::utf8_arguments(argc, argv);
    try {
        session->check_arguments(arguments);
        geodisk::tools::run_arguments(set_up, std::move(arguments));
    } catch (const geodisk::tools::UserError&) {
        // The first process has the same arguments.
    }
    session->help(nullptr);
}

int run(int argc, char** argv) {
    Session all;
    session = &all;
    if (all.is_first()) {
        return geodisk::tools::run_program("geodisk_mpi",
                                           "Random points on a triangle mesh, by many processes",
                                           set_up, argc, argv, check_alike);
    }
    help(argc, argv);
    return 0;
}

/// Makes the C library return what is freed to the system at once. Parts of a process would each
/// keep it otherwise.
void return_freed_memory() {
#if defined(__GLIBC__)
    constexpr int kLargest = 1 << 20; // Larger blocks are never kept.
    mallopt(M_MMAP_THRESHOLD, kLargest);
    mallopt(M_ARENA_MAX, 1);
#endif
}

} // namespace

int main(int argc, char** argv) {
    return_freed_memory();
    geodisk::tools::receive_termination();
    int level = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &level);
    int status = 0;
    try {
        status = run(argc, argv);
    } catch (const std::exception& error) {
        // A process that fails by itself ends all others.
        std::cerr << "geodisk_mpi: " << error.what() << '\n';
        status = static_cast<int>(geodisk::tools::ExitCode::internal);
        MPI_Abort(MPI_COMM_WORLD, status);
    }
    if (status > 128) { // By a signal, while others may wait.
        MPI_Abort(MPI_COMM_WORLD, status);
    }
    MPI_Finalize();
    return status;
}
