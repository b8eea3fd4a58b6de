#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

[[noreturn]] static void fail(const geodisk::Error& error) {
    std::fprintf(stderr, "%s: %s\n", geodisk::to_string(error.status), error.message.c_str());
    std::exit(EXIT_FAILURE);
}

int main() {
    // A tetrahedron: three coordinates per vertex, three vertices per face.
    const std::vector<double> positions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};

    // Connectivity and intrinsic geometry; one for all distances and seeds.
    auto mesh = geodisk::PreparedMesh::prepare({positions, triangles});
    if (!mesh)
        fail(mesh.error());

    // A device of geodisk's own. An engine passes its VkDevice and VkQueue to Runner instead.
    auto context = geodisk::Context::create();
    if (!context)
        fail(context.error());
    auto runner = geodisk::Runner::create(context->device(), context->queue());
    if (!runner)
        fail(runner.error());

    auto result = runner->sample_and_wait(*mesh, {.min_distance = 0.2, .seed = 7});
    if (!result)
        fail(result.error());

    std::printf("%zu samples\n", result->samples.size());
    for (const geodisk::Sample& sample : result->samples) {
        double point[3] = {};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::size_t vertex = triangles[std::size_t{3} * sample.face + corner];
            for (std::size_t axis = 0; axis < 3; ++axis)
                point[axis] += sample.weights[corner] * positions[3 * vertex + axis];
        }
        std::printf("%g %g %g\n", point[0], point[1], point[2]);
    }
}
