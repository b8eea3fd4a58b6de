// Several devices, runners and threads at once: none disturbs another.
#include <doctest/doctest.h>

#include <array>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "gpu/device_run.hpp"
#include "gpu/sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

struct Work {
    PreparedMesh mesh;
    SampleParams params;
};

Work work(const char* shape, int resolution, double count, std::uint64_t seed) {
    PreparedMesh mesh = prepared(builtin(shape, resolution));
    const SampleParams params = params_for(mesh, count, seed);
    return {std::move(mesh), params};
}

/// Differing in every buffer's size, so that what one run leaves behind would show in another.
const std::vector<Work>& all_work() {
    static const std::vector<Work> kWork = [] {
        std::vector<Work> made;
        made.push_back(work("torus-knot", 8, 200, 1));
        made.push_back(work("icosphere", 3, 60, 2));
        made.push_back(work("cube", 1, 400, 3));
        made.push_back(work("torus-knot", 8, 90, 4));
        return made;
    }();
    return kWork;
}

Points wanted(const Work& work, const SampleSet& set) {
    return float_set(work.mesh, work.params, set.report.plan.error_bound);
}

void check_run(Runner& runner, const Work& work) {
    const SampleSet set = expect(runner.sample_and_wait(work.mesh, work.params));
    CHECK(points_of(set) == wanted(work, set));
}

Runner runner_on(const Context& context) {
    return expect(Runner::create(context.device(), context.queue()));
}

/// Runs all work once per runner, each runner in a thread of its own.
void check_in_threads(std::array<Runner*, 2> runners) {
    std::array<std::vector<Result<SampleSet>>, 2> results;
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < runners.size(); ++t) {
            threads.emplace_back([&, t] {
                for (std::size_t i = 0; i < all_work().size(); ++i) {
                    // In opposite orders.
                    const std::size_t k = t == 0 ? i : all_work().size() - 1 - i;
                    const Work& next = all_work()[k];
                    results[t].push_back(runners[t]->sample_and_wait(next.mesh, next.params));
                }
            });
        }
    }
    for (std::size_t t = 0; t < runners.size(); ++t) {
        for (std::size_t i = 0; i < all_work().size(); ++i) {
            const Work& done = all_work()[t == 0 ? i : all_work().size() - 1 - i];
            const SampleSet set = expect(std::move(results[t][i]));
            CHECK(points_of(set) == wanted(done, set));
        }
    }
}

} // namespace

TEST_SUITE("several at once") {
    TEST_CASE("runners of two devices take turns, then run side by side") {
        const Context first = expect(Context::create());
        const Context second = expect(Context::create());
        CHECK(first.device().device != second.device().device);
        Runner a = runner_on(first);
        Runner b = runner_on(second);
        for (const Work& next : all_work()) {
            check_run(a, next);
            check_run(b, next);
        }
        check_in_threads({&a, &b});
    }

    TEST_CASE("two runners of one queue run side by side") {
        ContextOptions options;
        options.validation = true;
        const Context context = expect(Context::create(options));
        {
            Runner a = runner_on(context);
            Runner b = runner_on(context);
            check_in_threads({&a, &b});
        }
        CHECK(expect(context.validation_messages()) == std::vector<std::string>{});
    }

    TEST_CASE("two runners are created side by side") {
        const Context context = expect(Context::create());
        std::array<std::optional<Result<Runner>>, 2> runners;
        {
            std::vector<std::jthread> threads;
            threads.reserve(runners.size());
            for (auto& runner : runners) {
                threads.emplace_back(
                    [&] { runner.emplace(Runner::create(context.device(), context.queue())); });
            }
        }
        for (auto& runner : runners) {
            Runner made = expect(std::move(*runner));
            check_run(made, all_work()[1]);
        }
    }

    TEST_CASE("a moved runner works on, also over another one, and its device may move") {
        std::optional<Context> home; // Outlives the runners.
        Context context = expect(Context::create());
        Runner first = runner_on(context);
        check_run(first, all_work()[1]);
        Runner second = std::move(first);
        check_run(second, all_work()[2]);
        Runner third = runner_on(context);
        third = std::move(second);
        check_run(third, all_work()[3]);
        home.emplace(std::move(context));
        check_run(third, all_work()[0]);
        first = std::move(third); // Into one that was moved from.
        check_run(first, all_work()[1]);
    }
}

} // namespace geodisk::test
