// Samples a tetrahedron through the public interface alone and checks what must hold: the spacing
// within each face, where the geodesic distance is the straight one, the density, and that a
// second run and another plan return the same samples.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/version.hpp>

#include <geodisk/shaders/records.h>

namespace {

using Point = std::vector<double>;

const std::vector<double> kPositions = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
const std::vector<std::uint32_t> kTriangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
constexpr double kMinDistance = 0.15;

void require(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "does not hold: %s\n", what);
        std::exit(EXIT_FAILURE);
    }
}

template <class T>
T take(geodisk::Result<T> result, const char* what) {
    if (!result) {
        std::fprintf(stderr, "%s: %s: %s\n", what, geodisk::to_string(result.error().status),
                     result.error().message.c_str());
        std::exit(EXIT_FAILURE);
    }
    return std::move(result).value();
}

Point point_of(const geodisk::Sample& sample) {
    Point point(3);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t vertex = kTriangles[std::size_t{3} * sample.face + corner];
        for (std::size_t axis = 0; axis < 3; ++axis)
            point[axis] += sample.weights[corner] * kPositions[3 * vertex + axis];
    }
    return point;
}

double straight(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

void check_samples(const std::vector<geodisk::Sample>& samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const geodisk::Sample& sample = samples[i];
        require(sample.face < kTriangles.size() / 3, "the face is one of the mesh");
        require(sample.weights[0] + sample.weights[1] + sample.weights[2] == 1.0f,
                "the weights sum to 1");
        require(sample.weights[0] >= 0 && sample.weights[1] >= 0 && sample.weights[2] >= 0,
                "no weight is negative");
        const Point point = point_of(sample);
        for (std::size_t j = 0; j < i; ++j)
            require(samples[j].face != sample.face ||
                        straight(point, point_of(samples[j])) >= kMinDistance,
                    "samples of one face keep the minimum distance");
    }
}

bool same(const std::vector<geodisk::Sample>& a, const std::vector<geodisk::Sample>& b) {
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].face != b[i].face || a[i].weights[1] != b[i].weights[1] ||
            a[i].weights[2] != b[i].weights[2])
            return false;
    return true;
}

void check_plan(const geodisk::Sampler& sampler, const geodisk::Domain& domain) {
    const auto plan = take(sampler.plan_run(domain, 1 << 24), "plan_run");
    require(plan.lane_rows() > 0 && plan.pool_bytes() <= 1 << 24, "the plan keeps to its pool");
    const auto needs = take(sampler.workspace_needs(domain, plan), "workspace_needs");
    require(needs.total() >= plan.pool_bytes(), "the workspace holds the pool");
}

} // namespace

int main() {
    static_assert(sizeof(geodisk::gpu::SampleRec) == 16);
    const auto mesh = take(geodisk::PreparedMesh::prepare({kPositions, kTriangles}), "prepare");
    const geodisk::SampleParams params{.min_distance = kMinDistance, .seed = 11};
    const double area = mesh.statistics().area;
    require(std::abs(area - 8 * std::sqrt(3.0)) < 1e-9, "the area is that of the tetrahedron");

    const auto context = take(geodisk::Context::create(), "Context");
    auto runner = take(geodisk::Runner::create(context.device(), context.queue()), "Runner");
    check_plan(runner.sampler(), take(geodisk::Domain::surface(mesh, params), "Domain"));
    const auto set = take(runner.sample_and_wait(mesh, params), "sample");
    check_samples(set.samples);
    const auto count = static_cast<double>(set.samples.size());
    const double density = geodisk::packing_density(area, kMinDistance, count);
    require(density > 0.65 && density < 0.78, "the density is that of a Poisson-disk set");
    const double pool = take(geodisk::pool_size(mesh, params), "pool_size");
    require(std::abs(set.report.candidates - pool) < 6 * std::sqrt(pool),
            "the report tells of about as many candidates as the pool expects");
    auto fewer = params;
    fewer.stop_count = static_cast<std::uint32_t>(set.samples.size() / 2);
    const auto first = take(runner.sample_and_wait(mesh, fewer), "sample up to a count");
    require(same(first.samples, {set.samples.begin(), set.samples.begin() + fewer.stop_count}),
            "samples come in dart-throwing order");

    const auto again = take(runner.sample_and_wait(mesh, params), "sample again");
    require(same(set.samples, again.samples), "a second run returns the same samples");
    geodisk::RunnerOptions options;
    options.plan.slots = geodisk::kMinSlots;
    options.sampler.rounding = geodisk::Rounding::emulated;
    auto other =
        take(geodisk::Runner::create(context.device(), context.queue(), options), "another Runner");
    const auto planned = take(other.sample_and_wait(mesh, params), "sample by another plan");
    require(same(set.samples, planned.samples), "another plan returns the same samples");

    std::printf("geodisk %s: %zu samples on %s\n", GEODISK_VERSION_STRING, set.samples.size(),
                context.report().name.c_str());
}
