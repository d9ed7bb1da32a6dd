/// Counts what a program asks of MPI, by its profiling interface (MPI-3.1, chapter 14): loaded before the
/// program (LD_PRELOAD), it says so at the end.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <cstdio>

namespace {

int sends = 0, reductions = 0, exchanges = 0;

}  // namespace

extern "C" {

int MPI_Isend(const void* from, int count, MPI_Datatype type, int to, int tag, MPI_Comm all,
              MPI_Request* request) {
    ++sends;
    return PMPI_Isend(from, count, type, to, tag, all, request);
}

int MPI_Iallreduce(const void* from, void* result, int count, MPI_Datatype type, MPI_Op what, MPI_Comm all,
                   MPI_Request* request) {
    ++reductions;
    return PMPI_Iallreduce(from, result, count, type, what, all, request);
}

int MPI_Ialltoall(const void* from, int count, MPI_Datatype type, void* result, int resultCount,
                  MPI_Datatype resultType, MPI_Comm all, MPI_Request* request) {
    ++exchanges;
    return PMPI_Ialltoall(from, count, type, result, resultCount, resultType, all, request);
}

int MPI_Finalize() {
    std::fprintf(stderr, "%d sends, %d reductions, %d exchanges\n", sends, reductions, exchanges);
    return PMPI_Finalize();
}

}  // extern "C"
