// Samples a tetrahedron by all processes; the first one prints the samples.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <mpi.h>

#include <geodisk/context.hpp>
#include <geodisk/mpi.hpp>
#include <geodisk/runner.hpp>

namespace {

int fail(const geodisk::Error& error) {
    std::fprintf(stderr, "%s: %s\n", geodisk::to_string(error.status), error.message.c_str());
    MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
}

int sample() {
    auto context = geodisk::Context::create();
    if (!context)
        return fail(context.error());
    auto runner = geodisk::Runner::create(context->device(), context->queue());
    if (!runner)
        return fail(runner.error());

    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) {
        const auto helped = geodisk::sample_together(MPI_COMM_WORLD, *runner, nullptr, nullptr);
        return helped ? 0 : fail(helped.error());
    }
    const std::vector<double> positions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    const auto mesh = geodisk::PreparedMesh::prepare({positions, triangles});
    if (!mesh)
        return fail(mesh.error());
    const geodisk::SampleParams params{.min_distance = 0.2, .seed = 7};
    const auto result = geodisk::sample_together(MPI_COMM_WORLD, *runner, &*mesh, &params);
    if (!result)
        return fail(result.error());

    std::printf("%zu samples\n", result->set.samples.size());
    for (const geodisk::Sample& sample : result->set.samples)
        std::printf("%u %g %g\n", sample.face, sample.weights[1], sample.weights[2]);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const int status = sample();
    MPI_Finalize();
    return status;
}
