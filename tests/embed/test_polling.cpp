// Runs that do not block.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/neighbours.hpp>

#include "watched_bench.hpp"

namespace geodisk::test {
namespace {

/// Polls to the end of a run; what came, and how often it was asked for.
struct Polled {
    SampleSet set;
    std::uint32_t polls = 0;
};

Polled polled(Runner& runner, std::chrono::milliseconds patience = std::chrono::milliseconds(1)) {
    for (std::uint32_t polls = 1;; ++polls) {
        auto set = expect(runner.poll(patience));
        if (set) {
            return {std::move(*set), polls};
        }
    }
}

std::string refusal(const Result<Done>& result) {
    REQUIRE_FALSE(result);
    CHECK(result.error().status == Status::invalid_argument);
    return result.error().message;
}

/// A search on the mesh of a bench, from all vertices.
struct Search {
    explicit Search(const PreparedMesh& of) : mesh(of), sources(expect(vertex_points(of)).points) {
        query.sources = sources;
        query.within = std::sqrt(mesh.statistics().area) / 5;
    }

    void check(const Result<Neighbours>& found) const {
        REQUIRE_MESSAGE(found, (found ? "" : found.error().message));
        static Context context = expect(Context::create());
        Runner runner = expect(Runner::create(context.device(), context.queue()));
        const Neighbours wanted = expect(find_neighbours(runner, mesh, query));
        CHECK(found->offsets == wanted.offsets);
        CHECK(found->indices == wanted.indices);
        CHECK(found->distances == wanted.distances);
        CHECK(found->error == wanted.error);
    }

    const PreparedMesh& mesh;
    std::vector<Sample> sources;
    NeighbourQuery query;
};

/// Polls to the end of a search, and counts the polls.
Neighbours polled_neighbours(Runner& runner, std::uint32_t& polls) {
    for (polls = 1;; ++polls) {
        auto found = expect(poll_neighbours(runner, std::chrono::milliseconds(1)));
        if (found) {
            return std::move(*found);
        }
    }
}

} // namespace

TEST_SUITE("polling") {
    TEST_CASE("a run goes on poll by poll, and gives the same set") {
        Bench bench;
        RunnerOptions options;
        SUBCASE("as planned") {}
        SUBCASE("with memory that grows, chunk by chunk") {
            options.plan.stages = 1;
            options.plan.slots = 8;
            options.plan.sample_capacity = 9;
            options.plan.window_capacity = 2;
            options.plan.table_capacity = 4;
            options.plan.list_capacity = 4;
        }
        SUBCASE("with timestamps") {
            options.time_stages = true;
        }
        Runner runner = expect(bench.create(options));
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        for (int turn = 0; turn < 2; ++turn) {
            CHECK(runner.fence() == VK_NULL_HANDLE);
            expect(runner.start(domain));
            CHECK(runner.fence() != VK_NULL_HANDLE);
            bench.check_set(polled(runner).set);
            CHECK(runner.fence() == VK_NULL_HANDLE);
        }
        bench.check_run(runner);
    }

    TEST_CASE("a poll without patience returns while the device is at work") {
        Bench bench;
        Runner runner = expect(bench.create());
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        expect(runner.start(domain));
        bench.spy.never_signal = true;
        for (int i = 0; i < 100; ++i) {
            CHECK_FALSE(expect(runner.poll()));
        }
        bench.spy.never_signal = false;
        bench.check_set(polled(runner).set);
    }

    TEST_CASE("runners on one queue take turns") {
        Bench bench;
        const auto sampler =
            std::make_shared<const Sampler>(expect(Sampler::create(bench.context.device(), {})));
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        std::vector<Runner> runners;
        for (int i = 0; i < 3; ++i) {
            runners.push_back(expect(Runner::create(sampler, bench.context.queue())));
            expect(runners.back().start(domain));
        }
        std::uint32_t complete = 0;
        std::vector<bool> done(runners.size(), false);
        while (complete < runners.size()) {
            for (std::size_t i = 0; i < runners.size(); ++i) {
                if (done[i]) {
                    continue;
                }
                auto set = expect(runners[i].poll());
                if (set) {
                    bench.check_set(std::move(*set));
                    done[i] = true;
                    ++complete;
                }
            }
        }
    }

    TEST_CASE("a run may be cancelled, or go with its runner, at any time") {
        Bench bench;
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        RunnerOptions options;
        options.plan.stages = 1; // More submissions.
        for (std::uint32_t polls = 0; polls < 12; ++polls) {
            CAPTURE(polls);
            Runner runner = expect(bench.create(options));
            expect(runner.start(domain));
            for (std::uint32_t i = 0; i < polls; ++i) {
                if (expect(runner.poll())) {
                    break;
                }
            }
            runner.cancel();
            runner.cancel();
            CHECK(runner.fence() == VK_NULL_HANDLE);
            bench.check_run(runner);
            expect(runner.start(domain));
            runner.release_memory(); // Not now.
        }
        CHECK(bench.spy.alive().empty());
        CHECK(bench.spy.strangers() == 0);
    }

    TEST_CASE("what a progress callback stops, and what fails, ends the run") {
        Bench bench;
        Runner runner = expect(bench.create());
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        expect(runner.start(domain, [](const Progress&) { return false; }));
        Result<std::optional<SampleSet>> set = std::optional<SampleSet>();
        while (set && !*set) {
            set = runner.poll(std::chrono::milliseconds(1));
        }
        REQUIRE_FALSE(set);
        CHECK(set.error().status == Status::cancelled);
        CHECK(runner.progress().candidates > 0);
        bench.spy.fail("vkQueueSubmit", 0, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        expect(runner.start(domain));
        set = runner.poll();
        REQUIRE_FALSE(set);
        CHECK(set.error().status == Status::out_of_device_memory);
        CHECK(bench.spy.end_of_fault());
        bench.check_run(runner);
    }

    TEST_CASE("a run can be cancelled while its candidates are drawn") {
        Bench bench;
        RunnerOptions options;
        options.submission_seconds = 1e-9; // Many submissions.
        bench.params = params_for(bench.mesh, 20'000);
        Runner runner = expect(bench.create(options));
        std::uint32_t asked = 0, accepted = 0;
        const auto cancelled =
            runner.sample_and_wait(bench.mesh, bench.params, [&](const Progress& state) {
                accepted = state.accepted;
                CHECK(state.candidates > 0);
                return ++asked < 5;
            });
        REQUIRE_FALSE(cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
        CHECK(asked == 5);
        CHECK(accepted == 0);
        bench.check_run(runner);
    }

    TEST_CASE("a search for neighbours goes on poll by poll, and finds the same") {
        Bench bench;
        Search search(bench.mesh);
        RunnerOptions options;
        SUBCASE("within a distance") {}
        SUBCASE("the nearest ones, however far") {
            search.query.within = 0;
            search.query.nearest = 40;
        }
        SUBCASE("with memory that grows") {
            options.plan.slots = 8;
            options.plan.window_capacity = 2;
            options.plan.table_capacity = 4;
            options.device_bytes = 4 << 20;
        }
        Runner runner = expect(bench.create(options));
        for (int turn = 0; turn < 2; ++turn) {
            std::uint32_t last = 0, told = 0;
            const auto count = static_cast<std::uint32_t>(search.sources.size());
            expect(start_neighbours(runner, bench.mesh, search.query, [&](const Progress& now) {
                CHECK(now.candidates == count);
                CHECK(now.decided >= last);
                CHECK(now.decided <= count);
                last = now.decided;
                ++told;
                return true;
            }));
            CHECK(runner.fence() != VK_NULL_HANDLE);
            std::uint32_t polls = 0;
            search.check(polled_neighbours(runner, polls));
            CHECK(polls > 1);
            CHECK(told > 1);
            CHECK(runner.fence() == VK_NULL_HANDLE);
        }
        bench.check_run(runner);
    }

    TEST_CASE("a search may be cancelled, or go with its runner, at any time") {
        Bench bench;
        Search search(bench.mesh);
        search.query.within = 0;
        search.query.nearest = 40; // Several jobs.
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        for (std::uint32_t polls = 0; polls < 12; ++polls) {
            CAPTURE(polls);
            Runner runner = expect(bench.create());
            expect(start_neighbours(runner, bench.mesh, search.query));
            for (std::uint32_t i = 0; i < polls; ++i) {
                if (expect(poll_neighbours(runner, std::chrono::seconds(1)))) {
                    break;
                }
            }
            runner.cancel();
            CHECK(runner.fence() == VK_NULL_HANDLE);
            bench.check_run(runner);
            search.check(find_neighbours(runner, bench.mesh, search.query));
            expect(start_neighbours(runner, bench.mesh, search.query));
        }
        CHECK(bench.spy.alive().empty());
    }

    TEST_CASE("searches and runs of a runner exclude each other") {
        Bench bench;
        const Search search(bench.mesh);
        Runner runner = expect(bench.create());
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        CHECK(poll_neighbours(runner).error().message == "no run is in progress");
        expect(runner.start(domain));
        CHECK(refusal(start_neighbours(runner, bench.mesh, search.query)) ==
              "a run is in progress");
        CHECK(poll_neighbours(runner).error().status == Status::invalid_argument);
        bench.check_set(polled(runner).set);
        expect(start_neighbours(runner, bench.mesh, search.query));
        CHECK(refusal(runner.start(domain)) == "a run is in progress");
        CHECK(runner.poll().error().status == Status::invalid_argument);
        CHECK_FALSE(find_neighbours(runner, bench.mesh, search.query));
        std::uint32_t polls = 0;
        search.check(polled_neighbours(runner, polls));
        NeighbourQuery none;
        CHECK(refusal(start_neighbours(runner, bench.mesh, none)) == "there is no source");
        expect(start_neighbours(runner, bench.mesh, search.query,
                                [](const Progress&) { return false; }));
        Result<std::optional<Neighbours>> found = std::optional<Neighbours>();
        while (found && !*found) {
            found = poll_neighbours(runner, std::chrono::milliseconds(1));
        }
        REQUIRE_FALSE(found);
        CHECK(found.error().status == Status::cancelled);
        search.check(find_neighbours(runner, bench.mesh, search.query));
    }

    TEST_CASE("one run at a time") {
        Bench bench;
        Runner runner = expect(bench.create());
        const Domain domain = expect(Domain::surface(bench.mesh, bench.params));
        const auto none = runner.poll();
        REQUIRE_FALSE(none);
        CHECK(none.error().message == "no run is in progress");
        expect(runner.start(domain));
        CHECK(refusal(runner.start(domain)) == "a run is in progress");
        const auto waiting = runner.sample_and_wait(bench.mesh, bench.params);
        REQUIRE_FALSE(waiting);
        CHECK(waiting.error().message == "a run is in progress");
        bench.check_set(polled(runner).set);
    }
}

} // namespace geodisk::test
