// Loaded before MPI: one process, GEODISK_FAILING_RANK, has no memory for the message that it
// receives as number GEODISK_FAILING_MESSAGE.
#include <cstdlib>
#include <new>

#include <mpi.h>

namespace {

int number_in(const char* name) {
    const char* const text = std::getenv(name);
    return text == nullptr ? -1 : std::atoi(text);
}

} // namespace

extern "C" int MPI_Mrecv(void* data, int count, MPI_Datatype type, MPI_Message* message,
                         MPI_Status* status) {
    static int received = 0;
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == number_in("GEODISK_FAILING_RANK") &&
        ++received == number_in("GEODISK_FAILING_MESSAGE")) {
        throw std::bad_alloc();
    }
    return PMPI_Mrecv(data, count, type, message, status);
}
