// Whole runs on the device, on small complexes of triangles of any kind, with any distance, radii
// and plan: the set is that of sequential dart throwing as the float twin decides, and its
// decisions are those of double precision but for ties within the guard.
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include "fuzz/complex_input.hpp"
#include "gpu/sets.hpp"
#include "kernels/detect.hpp"
#include "support/replay.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

using namespace geodisk;
using namespace geodisk::test;

namespace {

constexpr std::uint32_t kMaxCandidatesTried = 2000;

/// One that has room for everything, one whose memory has to grow, one whose disks all trim, one
/// whose disks are computed by work groups, and one where lanes leave most to groups.
std::array<Runner, 5>& runners() {
    static std::array<Runner, 5> all = [] {
        RunPlan tight;
        tight.slots = 8;
        tight.window_capacity = 2;
        tight.table_capacity = 8;
        tight.list_capacity = 4;
        tight.sample_capacity = 10;
        tight.stages = 1;
        RunPlan trimming;
        trimming.trims = true;
        RunPlan groups;
        groups.disks_by = DisksBy::groups;
        groups.window_capacity = 2;
        RunPlan leaving;
        leaving.large_groups = 2;
        leaving.large_after = 10;
        leaving.large_window_capacity = 2;
        const auto runner = [](const RunPlan& plan) {
            RunnerOptions options;
            options.plan = plan;
            const Context& context = shared_context();
            return expect(Runner::create(context.device(), context.queue(), options));
        };
        return std::array{runner({}), runner(tight), runner(trimming), runner(groups),
                          runner(leaving)};
    }();
    return all;
}

std::optional<RadiusField> radii_of(Input& input, const PreparedMesh& mesh) {
    if (input.next(3) != 0) {
        return std::nullopt;
    }
    std::vector<double> factors;
    for (std::size_t v = 0; v < mesh.fans().size(); ++v) {
        factors.push_back((1 + input.next(8)) / 8.0);
    }
    auto field = RadiusField::prepare(mesh, factors);
    return field ? std::optional(std::move(*field)) : std::nullopt;
}

void require(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "%s\n", what);
        __builtin_trap();
    }
}

void check(Input& input, const PreparedMesh& mesh) {
    const std::optional<RadiusField> radii = radii_of(input, mesh);
    SampleParams params;
    params.seed = input.next(256);
    params.min_distance = 2 * mesh.statistics().diagonal / (1 + input.next(24));
    params.radii = radii ? &*radii : nullptr;
    Runner& runner = runners()[input.next(5)];
    const auto candidates = pool_size(mesh, params);
    if (!candidates || *candidates > kMaxCandidatesTried) {
        return;
    }
    const auto set = runner.sample_and_wait(mesh, params);
    if (!set) {
        require(set.error().status == Status::mesh_rejected, set.error().message.c_str());
        return;
    }
    const double bound = set->report.plan.error_bound;
    require(points_of(*set) == float_set(mesh, params, bound), "not the set of the float twin");
    require(replay(mesh, params, bound).wrong == 0, "wrong by double precision");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input input({data, size});
    const TestMesh complex = complex_of(input);
    const auto mesh = PreparedMesh::prepare(complex.view(), ThreadOptions{1});
    if (!mesh || !(mesh->statistics().diagonal > 0)) {
        return 0;
    }
    try {
        check(input, *mesh);
    } catch (const ref::EndlessDisk&) { // An error, not a wrong set.
    }
    return 0;
}
