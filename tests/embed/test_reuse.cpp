// Objects that a runner keeps from run to run, and those that a job keeps.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gpu/device_run.hpp"
#include "support/radius_fields.hpp"
#include "watched_bench.hpp"

namespace geodisk::test {
namespace {

// Functions that make or allocate something.
constexpr const char* kMaking[] = {
    "vkAllocateMemory",       "vkCreateBuffer",           "vkCreateBufferView",
    "vkCreateDescriptorPool", "vkAllocateDescriptorSets", "vkCreateComputePipelines",
    "vkCreateFence",          "vkCreateCommandPool",      "vkAllocateCommandBuffers"};

std::uint32_t made(const Bench& bench) {
    std::uint32_t calls = 0;
    for (const char* function : kMaking) {
        calls += bench.spy.calls(function);
    }
    return calls;
}

Points reference(const PreparedMesh& mesh, const SampleParams& params, const SampleSet& set) {
    return float_set(mesh, params, set.report.plan.error_bound);
}

} // namespace

TEST_SUITE("reuse") {
    TEST_CASE("a second run makes nothing and takes two submissions") {
        Bench bench;
        RunnerOptions options;
        options.submission_seconds = 2; // However slow the machine is now.
        Runner runner = expect(bench.create(options));
        bench.check_run(runner);
        for (const std::uint64_t seed : {0u, 7u, 8u}) {
            bench.params.seed = seed;
            const std::uint32_t before = made(bench);
            const std::uint32_t submitted = bench.spy.calls("vkQueueSubmit");
            const SampleSet set = expect(runner.sample_and_wait(bench.mesh, bench.params));
            CHECK(points_of(set) == reference(bench.mesh, bench.params, set));
            CHECK(made(bench) == before);
            CHECK(bench.spy.calls("vkQueueSubmit") - submitted <= 2);
        }
    }

    TEST_CASE("memory grows with a larger job, serves smaller ones, and can be released") {
        Bench bench;
        Runner runner = expect(bench.create());
        const auto check = [&](double count) {
            const SampleParams params = params_for(bench.mesh, count);
            const SampleSet set = expect(runner.sample_and_wait(bench.mesh, params));
            CHECK(points_of(set) == reference(bench.mesh, params, set));
        };
        check(30);
        const std::uint32_t small = made(bench);
        check(3000);
        const std::uint32_t large = made(bench);
        CHECK(large > small);
        check(30);
        check(30);
        check(3000);
        CHECK(made(bench) == large);
        runner.release_memory();
        CHECK(bench.spy.calls("vkFreeMemory") == bench.spy.calls("vkAllocateMemory"));
        runner.release_memory();
        check(30);
    }

    TEST_CASE("domains of all kinds follow each other") {
        Bench bench;
        Runner runner = expect(bench.create());
        const TestMesh shape = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(shape);
        const RadiusField radii = radius_field(mesh, wavy_factors(shape, 0.5));
        BoxParams box{{1, 1}, true};
        box.min_distance = distance_for_count(box, 60);
        std::vector<Domain> domains;
        domains.push_back(expect(Domain::surface(mesh, params_for(mesh, 200))));
        domains.push_back(expect(Domain::surface(mesh, params_for(mesh, 100, 1, &radii))));
        domains.push_back(expect(Domain::box(box)));
        domains.push_back(expect(Domain::surface_in_space(shape.view(), mesh, params_for(mesh, 100),
                                                          Metric::euclidean)));
        domains.push_back(expect(Domain::surface(mesh, params_for(mesh, 5000))));
        std::vector<SampleSet> alone;
        for (const Domain& domain : domains) {
            Runner other = expect(bench.create());
            alone.push_back(expect(other.sample_and_wait(domain)));
        }
        for (int turn = 0; turn < 2; ++turn) {
            for (std::size_t i = 0; i < domains.size(); ++i) {
                for (std::size_t k = 0; k < domains.size(); ++k) {
                    CAPTURE(i);
                    CAPTURE(k);
                    expect(runner.sample_and_wait(domains[i]));
                    const SampleSet set = expect(runner.sample_and_wait(domains[k]));
                    CHECK(points_of(set) == points_of(alone[k]));
                    CHECK(set.points == alone[k].points);
                }
            }
        }
    }

    TEST_CASE(
        "a mesh that does not fit the staging is uploaded in pieces, by the caller's threads") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 7));
        SampleParams params = params_for(mesh, 20000);
        params.stop_count = 40;
        std::size_t blocks = 0;
        Bench bench;
        RunnerOptions options;
        options.threads.user = &blocks;
        options.threads.parallel_for = [](void* user, std::size_t count,
                                          void (*work)(void*, std::size_t), void* context) {
            for (std::size_t block = count; block-- > count / 3;) { // Leaves some out.
                work(context, block);
            }
            *static_cast<std::size_t*>(user) += count;
        };
        Runner runner = expect(bench.create(options));
        const SampleSet set = expect(runner.sample_and_wait(mesh, params));
        CHECK(set.report.uploaded > std::uint64_t{32} << 20);
        CHECK(blocks > 64);
        DeviceRun whole(mesh, params);
        whole.follow_all();
        REQUIRE(set.samples.size() == 40);
        const auto records = whole.read<gpu::SampleRec>(BufferRole::samples, 40);
        for (std::size_t i = 0; i < records.size(); ++i) {
            CHECK(set.samples[i].face == records[i].face);
            CHECK(set.samples[i].weights[1] == records[i].weight1);
        }
        // Cancelled with a piece in flight, then again.
        runner.release_memory();
        std::uint32_t calls = 0;
        const auto cancelled =
            runner.sample_and_wait(mesh, params, [&calls](const Progress&) { return ++calls < 2; });
        REQUIRE_FALSE(cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
        CHECK(points_of(expect(runner.sample_and_wait(mesh, params))) == points_of(set));
    }

    TEST_CASE("a run that fails, or is cancelled, leaves nothing to the next") {
        Bench bench;
        Runner runner = expect(bench.create());
        bench.check_run(runner);
        const auto cancelled =
            runner.sample_and_wait(bench.mesh, bench.params, [](const Progress&) { return false; });
        REQUIRE_FALSE(cancelled);
        CHECK(cancelled.error().status == Status::cancelled);
        CHECK(bench.spy.calls("vkFreeMemory") == bench.spy.calls("vkAllocateMemory"));
        bench.check_run(runner);
    }

    TEST_CASE("memory short beside what is kept is freed before it is an error") {
        Bench bench;
        Runner runner = expect(bench.create());
        bench.params = params_for(bench.mesh, 3000);
        bench.check_run(runner);
        const std::uint64_t kept =
            expect(runner.sample_and_wait(bench.mesh, bench.params)).report.device_bytes;
        // Room for the next job alone.
        bench.spy.memory_left = kept;
        bench.spy.gives_back = true;
        const SampleParams larger = params_for(bench.mesh, 4000);
        const SampleSet set = expect(runner.sample_and_wait(bench.mesh, larger));
        CHECK(points_of(set) == reference(bench.mesh, larger, set));
    }

    TEST_CASE("runners share a sampler, each on a thread of its own") {
        Bench bench;
        DeviceRefs refs = bench.context.device();
        refs.get_instance_proc_addr = &DeviceSpy::get_instance_proc_addr;
        const auto sampler = std::make_shared<const Sampler>(expect(Sampler::create(refs)));
        const QueueRef queue = bench.context.queue();
        Runner first = expect(Runner::create(sampler, queue));
        bench.check_run(first);
        const std::uint32_t pipelines = bench.spy.calls("vkCreateComputePipelines");
        const std::uint32_t submitted = bench.spy.calls("vkQueueSubmit");
        {
            Runner second = expect(Runner::create(sampler, queue));
            CHECK(bench.spy.calls("vkQueueSubmit") == submitted);
            bench.check_run(second);
        }
        bench.check_run(first);
        CHECK(bench.spy.calls("vkCreateComputePipelines") == pipelines);
        const auto none = Runner::create(nullptr, queue);
        REQUIRE_FALSE(none);
        CHECK(none.error().status == Status::invalid_argument);
    }

    TEST_CASE("threads sample with one sampler at a time") {
        const Context context = expect(Context::create());
        const auto sampler =
            std::make_shared<const Sampler>(expect(Sampler::create(context.device())));
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        std::mutex mutex;
        QueueRef queue = context.queue();
        queue.lock_user = &mutex;
        queue.lock = [](void* user) { static_cast<std::mutex*>(user)->lock(); };
        queue.unlock = [](void* user) { static_cast<std::mutex*>(user)->unlock(); };
        std::array<std::vector<Points>, 3> found;
        {
            std::vector<std::jthread> threads;
            for (std::size_t t = 0; t < found.size(); ++t) {
                threads.emplace_back([&, t] {
                    auto runner = Runner::create(sampler, queue);
                    for (double count : {50.0, 400.0, 60.0}) {
                        const auto set =
                            runner
                                ? runner->sample_and_wait(
                                      mesh, params_for(mesh, count + 10 * static_cast<double>(t)))
                                : Result<SampleSet>(runner.error());
                        found[t].push_back(set ? points_of(*set) : Points());
                    }
                });
            }
        }
        Runner alone = expect(Runner::create(sampler, queue));
        for (std::size_t t = 0; t < found.size(); ++t) {
            std::size_t i = 0;
            for (double count : {50.0, 400.0, 60.0}) {
                const SampleParams params = params_for(mesh, count + 10 * static_cast<double>(t));
                CHECK(found[t][i++] == points_of(expect(alone.sample_and_wait(mesh, params))));
            }
        }
    }

    TEST_CASE("a run makes do with the bytes it may take") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        Runner roomy = expect(bench.create());
        const SampleSet whole = expect(roomy.sample_and_wait(bench.mesh, bench.params));
        for (const double part : {1.0, 0.8, 0.6}) {
            CAPTURE(part);
            RunnerOptions options;
            options.device_bytes =
                static_cast<std::uint64_t>(part * static_cast<double>(whole.report.device_bytes));
            Runner runner = expect(bench.create(options));
            const SampleSet set = expect(runner.sample_and_wait(bench.mesh, bench.params));
            CHECK(points_of(set) == points_of(whole));
            CHECK(set.report.device_bytes <= options.device_bytes);
        }
        RunnerOptions options;
        options.device_bytes = 100'000;
        Runner tight = expect(bench.create(options));
        const auto refused = tight.sample_and_wait(bench.mesh, bench.params);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().status == Status::out_of_device_memory);
        CHECK(refused.error().message.find("may take only 100000") != std::string::npos);
    }

    TEST_CASE("what is kept from run to run, and what grows in one, stays within the bytes") {
        // Rounding of each buffer, which the device may round up.
        constexpr VkDeviceSize kRounding = kBufferRoles * 1024;
        RunnerOptions tight;
        tight.plan.window_capacity = 2;
        tight.plan.list_capacity = 4;
        for (RunnerOptions options : {RunnerOptions{}, growing(), tight}) {
            Bench bench;
            bench.spy.gives_back = true;
            const PreparedMesh large = prepared(builtin("torus-knot", 12));
            const PreparedMesh small = prepared(builtin("cube", 1));
            const std::pair<const PreparedMesh*, SampleParams> jobs[] = {
                {&large, params_for(large, 100)}, {&small, params_for(small, 3000)}};
            std::vector<Points> wanted;
            for (const auto& [mesh, params] : jobs) {
                Runner alone = expect(bench.create(options));
                const SampleSet set = expect(alone.sample_and_wait(*mesh, params));
                options.device_bytes = std::max(options.device_bytes, set.report.device_bytes);
                wanted.push_back(points_of(set));
            }
            bench.spy.memory_left = options.device_bytes + kRounding;
            Runner runner = expect(bench.create(options));
            for (std::size_t i = 0; i < 4; ++i) {
                const auto& [mesh, params] = jobs[i % 2];
                const SampleSet set = expect(runner.sample_and_wait(*mesh, params));
                CHECK(points_of(set) == wanted[i % 2]);
                CHECK(set.report.device_bytes <= options.device_bytes);
            }
            CHECK(bench.spy.refused == 0);
        }
    }

    TEST_CASE("kinds of domains take turns without new descriptors") {
        Bench bench;
        BoxParams box{{1, 1}, true};
        box.min_distance = 0.1;
        const Domain domains[] = {expect(Domain::surface(bench.mesh, bench.params)),
                                  expect(Domain::box(box))};
        Runner runner = expect(bench.create());
        std::vector<SampleSet> first;
        for (std::size_t i = 0; i < 6; ++i) {
            if (i == 4) { // All that they need is there.
                bench.spy.fail("vkCreateDescriptorPool", 0, VK_ERROR_OUT_OF_DEVICE_MEMORY);
            }
            const SampleSet set = expect(runner.sample_and_wait(domains[i % 2]));
            first.push_back(set);
            CHECK(points_of(set) == points_of(first[i % 2]));
            CHECK(set.points == first[i % 2].points);
        }
        CHECK_FALSE(bench.spy.end_of_fault());
    }

    TEST_CASE("where memory is short, half as much is tried") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        Runner runner = expect(bench.create());
        bench.spy.gives_back = true;
        const SampleSet whole = expect(runner.sample_and_wait(bench.mesh, bench.params));
        runner.release_memory();
        bench.spy.memory_left = whole.report.device_bytes * 3 / 4;
        const SampleSet set = expect(runner.sample_and_wait(bench.mesh, bench.params));
        CHECK(points_of(set) == points_of(whole));
        CHECK(set.report.device_bytes <= whole.report.device_bytes * 3 / 4);
    }

    TEST_CASE("and where half as much is too little, what lies between") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        bench.spy.gives_back = true;
        RunnerOptions options;
        options.device_bytes = 1;
        Runner none = expect(bench.create(options));
        const auto refused = none.sample_and_wait(bench.mesh, bench.params);
        REQUIRE_FALSE(refused);
        const std::string& message = refused.error().message;
        const std::uint64_t least = std::stoull(message.substr(message.find("takes ") + 6));
        Runner runner = expect(bench.create());
        const SampleSet whole = expect(runner.sample_and_wait(bench.mesh, bench.params));
        CHECK(whole.report.device_bytes > least);
        runner.release_memory();
        bench.spy.memory_left = least + kBufferRoles * std::uint64_t{1024};
        const SampleSet set = expect(runner.sample_and_wait(bench.mesh, bench.params));
        CHECK(points_of(set) == points_of(whole));
        runner.release_memory();
        bench.spy.memory_left = least / 2;
        const auto too_little = runner.sample_and_wait(bench.mesh, bench.params);
        REQUIRE_FALSE(too_little);
        CHECK(too_little.error().status == Status::out_of_device_memory);
        CHECK(too_little.error().message.find("on the device at least") != std::string::npos);
    }

    TEST_CASE("a job with another seed, and one renewed, in the same workspace") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        SampleParams params = params_for(mesh, 100);
        DeviceRun run(mesh, params);
        const auto check = [&] {
            while (decide_batch(run)) {
            }
            run.finish();
            CHECK(ready_points(run) == float_set(mesh, params, run.plan().error_bound));
        };
        run.begin();
        check();
        // The host's record of this job says nothing about another job in these buffers.
        const gpu::ControlRec before = run.control();
        Job other = expect(run.sampler().make_job(expect(Domain::surface(mesh, params)), run.plan(),
                                                  Job::Impl::of(run.job()).workspace));
        run.submit([&](VkCommandBuffer commands) { run.sampler().record_begin(commands, other); });
        CHECK(expect(other.advance(before)).next == Next::go_on);
        for (const std::uint64_t seed : {std::uint64_t{5}, std::uint64_t{1} << 40}) {
            params.seed = seed;
            run.job().set_seed(seed);
            CHECK(expect(run.job().advance(run.control())).next == Next::begin);
            run.begin();
            check();
        }
        params.seed = 3;
        params.stop_count = 20;
        expect(run.job().renew(expect(Domain::surface(mesh, params)), run.plan()));
        CHECK(expect(run.job().advance(before)).next == Next::begin);
        run.begin();
        check();
        // A larger domain does not fit, and the job can still be renewed.
        const SampleParams large = params_for(mesh, 1000);
        const auto refused = run.job().renew(expect(Domain::surface(mesh, large)), run.plan());
        REQUIRE_FALSE(refused);
        CHECK(refused.error().status == Status::workspace_too_small);
        expect(run.job().renew(expect(Domain::surface(mesh, params)), run.plan()));
        run.begin();
        check();
    }
}

} // namespace geodisk::test
