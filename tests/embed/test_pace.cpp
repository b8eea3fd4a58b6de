// Submissions keep to the time they are to take, on devices of any speed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/run/pace.hpp"
#include "engine/run/runner_impl.hpp"
#include "watched_bench.hpp"

namespace geodisk::test {
namespace {

/// Time passes with what is done alone: so much for each work group of a pass, each dispatch of a
/// round, and each step of a lane. A GPU takes several steps side by side: fewer than any GPU has
/// work groups in flight.
class SlowDevice {
  public:
    SlowDevice(Bench& bench, Runner& runner, double times) : slower(times), bench_(bench) {
        const bool cpu = bench.context.report().type == VK_PHYSICAL_DEVICE_TYPE_CPU;
        per_step_ = kPerStep / (cpu ? 1 : kSideBySide);
        Runner::Impl::of(runner).now = [this] { return now_; };
        bench.spy.on_dispatch = [this](std::uint32_t groups) {
            recorded_ += groups > 0 ? groups * kPerGroup : kPerDispatch;
            ++dispatches_;
        };
        bench.spy.on_done = [this](std::span<const std::span<std::byte>> mapped) {
            if (dispatches_ == 0) {
                return;
            }
            double taken = std::exchange(recorded_, 0);
            for (const std::span<std::byte> bytes : mapped) {
                gpu::ControlRec control{};
                std::memcpy(&control, bytes.data(), sizeof control);
                if (control.abi == gpu::kAbi) {
                    taken += (control.steps - std::exchange(steps_, control.steps)) * per_step_;
                }
            }
            seconds.push_back(slower * taken);
            now_ += slower * taken;
            dispatches.push_back(std::exchange(dispatches_, 0));
        };
    }
    ~SlowDevice() {
        bench_.spy.on_dispatch = nullptr;
        bench_.spy.on_done = nullptr;
    }
    SlowDevice(const SlowDevice&) = delete;
    SlowDevice& operator=(const SlowDevice&) = delete;

    /// Before another run.
    void forget() {
        steps_ = 0;
        seconds.clear();
    }

    double slower;
    std::vector<double> seconds; ///< Seconds of each submission.
    std::vector<std::uint32_t> dispatches;

  private:
    // About those of lavapipe.
    static constexpr double kPerGroup = 1e-4;
    static constexpr double kPerDispatch = 2e-5;
    static constexpr double kPerStep = 1e-5;
    static constexpr double kSideBySide = 4;

    Bench& bench_;
    double per_step_ = kPerStep;
    double now_ = 0;
    double recorded_ = 0;
    std::uint32_t dispatches_ = 0;
    std::uint32_t steps_ = 0;
};

double longest(const std::vector<double>& seconds) {
    return *std::max_element(seconds.begin(), seconds.end());
}

} // namespace

TEST_SUITE("pace") {
    TEST_CASE("work grows by four at most, by two where it is long, and shrinks at once") {
        Pace pace(0.1);
        const std::uint64_t first = pace.items();
        const auto took = [&](double seconds) { pace.took(seconds, pace.items()); };
        took(0.01);
        CHECK(pace.items() == 4 * first);
        took(0.02);
        CHECK(pace.items() == 8 * first);
        took(0.07); // As it should be.
        CHECK(pace.items() == 8 * first);
        pace.took(0.01, 2 * first); // Too little to tell.
        CHECK(pace.items() == 8 * first);
        took(0.4);
        CHECK(pace.items() == 2 * first);
        took(1e9);
        CHECK(pace.items() == first / 8);
        for (int i = 0; i < 100; ++i) {
            took(1e9);
        }
        CHECK(pace.items() == 1);
        for (int i = 0; i < 100; ++i) {
            took(0);
        }
        CHECK(pace.items() == std::uint64_t{1} << 40);
    }

    TEST_CASE("rounds are bounded by what they take if all lanes are busy") {
        Pace pace(0.1);
        for (int i = 0; i < 30; ++i) {
            pace.took(0.001, pace.items(), 10, 16); // 0.1 ms for each of few steps.
        }
        CHECK(pace.items() <= 16 * 10'000);
        CHECK(pace.items() > 16 * 9'000);
    }

    TEST_CASE("a run begins with as much as took the target in the run before") {
        Pace pace(0.1);
        CHECK(pace.begin_run(1000) == 1000); // Nothing is known.
        CHECK(pace.items() == 1000);
        for (int i = 0; i < 10; ++i) {
            pace.took(0.05, pace.items()); // However many there are.
        }
        pace.took(0.5, 90'000); // 100,000 in a second.
        const std::uint64_t before = pace.items();
        const std::uint64_t begun = pace.begin_run(1000);
        CHECK(begun <= 10'000);
        CHECK(begun >= 9'999);
        CHECK(pace.begin_run(50'000) == 50'000);
        CHECK(pace.items() == before); // Which does not enlarge it.
    }

    TEST_CASE("rounds of another run are bounded as if all lanes were busy") {
        const auto begun = [](std::uint32_t lanes) {
            Pace pace(0.1);
            for (int i = 0; i < 30; ++i) {
                pace.took(0.001, pace.items(), 100, 64); // 10 us for each step of 64 lanes.
            }
            return (pace.begin_run(1, lanes) + 8) / 16;
        };
        CHECK(begun(64) == 10'000);
        CHECK(begun(1000) == 10'000);
        CHECK(begun(16) == 2'500); // These may take as long together.
    }

    TEST_CASE("dispatches are as short as they must be, but for what the caller gives") {
        RunPlan plan;
        plan.slots = 100;
        plan.lanes = 16;
        plan.step_budget = 50;
        plan.detect_passes = 8;
        plan.dispatch_items = 1u << 17;
        const std::uint64_t whole = items_of_round(plan);
        CHECK(shortened(plan, {}, 1, whole).detect_passes == 8);
        const RunPlan half = shortened(plan, {}, 1, whole / 2);
        CHECK(half.detect_passes < 8);
        CHECK(half.step_budget == 50);
        CHECK(half.dispatch_items == 1);
        CHECK(shortened(plan, {}, 1000, 1).dispatch_items == 1000);
        CHECK(items_of_round(half) <= whole / 2 + std::uint64_t{16} * plan.slots);
        const RunPlan least = shortened(plan, {}, 1, 1);
        CHECK(least.detect_passes == 1);
        CHECK(least.step_budget == 1);
        CHECK(least.dispatch_items == 1);
        const RunPlan given = shortened(plan, plan, 1, 1);
        CHECK(given.detect_passes == 8);
        CHECK(given.step_budget == 50);
        CHECK(given.dispatch_items == 1u << 17);
    }

    TEST_CASE(
        "a small job fits a submission by the time of earlier ones, or if its steps are few") {
        Pace pace(0.1);
        CHECK(pace.fits(100));
        CHECK_FALSE(pace.fits(1000));
        pace.took(0.2, pace.items(), 100, 16); // 2 ms for each step.
        CHECK(pace.fits(450));
        CHECK_FALSE(pace.fits(550));
        pace.begin_run(1, 16);
        CHECK(pace.fits(450));
        CHECK_FALSE(pace.fits(550));
        Pace fast(0.1);
        fast.took(1e-6, fast.items(), 100, 16);
        CHECK(fast.fits(1000));
        CHECK_FALSE(fast.fits(10'000));
    }

    TEST_CASE("no submission is longer than two seconds, on a device however slow") {
        for (const double count : {5.0, 60.0, 120.0, 300.0, 600.0}) {
            Bench bench;
            bench.params = params_for(bench.mesh, count);
            for (const double slower : {1.0, 30.0, 300.0}) {
                CAPTURE(count);
                CAPTURE(slower);
                Runner runner = expect(bench.create());
                SlowDevice device(bench, runner, slower);
                bench.check_run(runner);
                CHECK(longest(device.seconds) < 2);
                CHECK(longest(device.seconds) > 0);
            }
        }
    }

    TEST_CASE("a later run begins with what is known, and stays short on another mesh") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        RunnerOptions options;
        options.submission_seconds = 0.1;
        Runner runner = expect(bench.create(options));
        SlowDevice device(bench, runner, 1);
        bench.check_run(runner);
        const std::size_t first = device.seconds.size();
        device.forget();
        bench.check_run(runner);
        CHECK(3 * device.seconds.size() <= 2 * first);
        CHECK(longest(device.seconds) < 2);
        const PreparedMesh other = prepared(builtin("torus-knot", 60));
        for (const double count : {20.0, 2000.0}) {
            device.forget();
            device.slower = 10; // Than on the other mesh.
            expect(runner.sample_and_wait(other, params_for(other, count)));
            CHECK(longest(device.seconds) < 2);
        }
        device.forget();
        device.slower = 1;
        bench.check_run(runner);
        CHECK(longest(device.seconds) < 2);
    }

    TEST_CASE("submissions take about the time they are to take") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        RunnerOptions options;
        options.submission_seconds = 0.05;
        Runner runner = expect(bench.create(options));
        SlowDevice device(bench, runner, 10);
        bench.check_run(runner);
        REQUIRE(device.seconds.size() > 12);
        CHECK(longest(device.seconds) < 2);
        std::vector<double> later(device.seconds.begin() + 7, device.seconds.end());
        std::sort(later.begin(), later.end());
        // A GPU has so many lanes that most are idle in this job. Still the submission must be
        // short if all are busy, so it often takes less than it may.
        const bool cpu = bench.context.report().type == VK_PHYSICAL_DEVICE_TYPE_CPU;
        CHECK(later[later.size() / 2] > 0.05 / (cpu ? 4 : 16));
        CHECK(later[later.size() / 2] < 0.05 * 1.5);
    }

    TEST_CASE("submissions grow again on a device that gets faster") {
        Bench bench;
        bench.params = params_for(bench.mesh, 2000);
        Runner runner = expect(bench.create());
        SlowDevice device(bench, runner, 300);
        const auto set = runner.sample_and_wait(bench.mesh, bench.params, [&](const Progress&) {
            device.slower = device.dispatches.size() < 20 ? 300 : 1e-3;
            return true;
        });
        bench.check_set(set);
        REQUIRE(device.dispatches.size() > 22);
        CHECK(*std::max_element(device.dispatches.begin(), device.dispatches.end()) >
              4 * device.dispatches[19]);
    }

    TEST_CASE("a step at a time, in disks and lists however long, is progress") {
        const Context context = expect(Context::create());
        const PreparedMesh mesh = prepared(builtin("icosphere", 3));
        SampleParams params = params_for(mesh, 6);
        params.pool_ratio = 1000;
        BoxParams box{{1, 1, 1}, true};
        box.pool_ratio = 10000;
        box.min_distance = distance_for_count(box, 20);
        RunnerOptions options;
        Runner fast = expect(Runner::create(context.device(), context.queue(), options));
        options.submission_seconds = 1e-9;
        Runner slow = expect(Runner::create(context.device(), context.queue(), options));
        const SampleSet set = expect(slow.sample_and_wait(mesh, params));
        CHECK(points_of(set) == points_of(expect(fast.sample_and_wait(mesh, params))));
        const Domain domain = expect(Domain::box(box));
        const SampleSet points = expect(slow.sample_and_wait(domain));
        CHECK(points.report.max_conflicts > 5 * gpu::kListPerDispatch);
        CHECK(points.points == expect(fast.sample_and_wait(domain)).points);
    }

    TEST_CASE("seconds that are no time are refused") {
        const Context& context = shared_context();
        for (double RunnerOptions::*const field :
             {&RunnerOptions::submission_seconds, &RunnerOptions::stall_seconds}) {
            for (const double seconds : {-1.0, std::nan(""), HUGE_VAL}) {
                RunnerOptions options;
                options.*field = seconds;
                const auto runner = Runner::create(context.device(), context.queue(), options);
                REQUIRE_FALSE(runner);
                CHECK(runner.error().status == Status::invalid_argument);
                CHECK(runner.error().message.find("_seconds is ") != std::string::npos);
            }
        }
    }

    TEST_CASE("a device that does nothing is an error, not an endless loop") {
        Bench bench;
        RunnerOptions options;
        options.plan.slots = kMinSlots;
        Runner runner = expect(bench.create(options));
        std::vector<std::byte> first;
        bench.spy.on_done = [&](std::span<const std::span<std::byte>> mapped) {
            for (const std::span<std::byte> bytes : mapped) {
                gpu::ControlRec control{};
                std::memcpy(&control, bytes.data(), sizeof control);
                if (control.abi != gpu::kAbi) {
                    continue;
                }
                if (first.empty()) {
                    control.done = 0; // As the device left it, but for its end.
                    std::memcpy(bytes.data(), &control, sizeof control);
                    first.assign(bytes.begin(), bytes.begin() + sizeof control);
                }
                std::copy(first.begin(), first.end(), bytes.begin());
            }
        };
        const auto set = runner.sample_and_wait(bench.mesh, bench.params);
        bench.spy.on_done = nullptr;
        REQUIRE_FALSE(set);
        CHECK(set.error().status == Status::internal);
        CHECK(set.error().message.find("no progress") != std::string::npos);
        bench.check_run(runner);
    }
}

} // namespace geodisk::test
