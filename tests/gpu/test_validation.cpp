// A whole run under the validation layer with synchronization validation: no message.
#include <vector>

#include <doctest/doctest.h>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/device_abilities.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {

TEST_SUITE("validation") {
    TEST_CASE("the validation layer has nothing to say about a run") {
        ContextOptions options;
        options.validation = true;
        Context context = expect(Context::create(options));
        const TestMesh knot = builtin("torus-knot", 8);
        const PreparedMesh mesh = prepared(knot);
        const SampleParams params = params_for(mesh, 300);
        const RadiusField radii = radius_field(mesh, wavy_factors(knot, 0.2));
        const SampleParams varying = params_for(mesh, 300, 1, &radii);
        for (const Reads reads : reads_of(context.report())) {
            // Slices that overflow bring in the rewind as well.
            RunnerOptions tight;
            tight.sampler.tuning.reads = reads;
            tight.plan.window_capacity = 2;
            Runner runner = expect(Runner::create(context.device(), context.queue(), tight));
            const SampleSet set = expect(runner.sample_and_wait(mesh, params));
            CHECK(set.report.regrown > 0);
            CHECK(points_of(set) == float_set(mesh, params, set.report.plan.error_bound));
            // So do work groups, for all disks or for those that lanes leave.
            RunnerOptions by_groups = tight;
            by_groups.plan.disks_by = DisksBy::groups;
            RunnerOptions leaving = tight;
            leaving.plan.large_groups = 2;
            leaving.plan.large_after = 10;
            std::vector<RunnerOptions> others;
            if (compiles_groups(context.report())) {
                others = {by_groups, leaving};
            }
            for (const RunnerOptions& other : others) {
                runner = expect(Runner::create(context.device(), context.queue(), other));
                CHECK(points_of(expect(runner.sample_and_wait(mesh, params))) == points_of(set));
            }
            // And later stages the samples of those before, in a buffer that has to grow.
            tight.plan.stages = 1;
            tight.plan.slots = 16;
            tight.plan.sample_capacity = 20;
            runner = expect(Runner::create(context.device(), context.queue(), tight));
            CHECK(points_of(expect(runner.sample_and_wait(mesh, params))) == points_of(set));

            CHECK(points_of(expect(runner.sample_and_wait(mesh, varying))) ==
                  float_set(mesh, varying, set.report.plan.error_bound));
        }
        for (const std::string& message : expect(context.validation_messages())) {
            MESSAGE(message);
        }
        CHECK(context.validation_message_count() == 0);

        // The layer is really there: it objects to a buffer of no bytes.
        const DeviceTable vk = expect(load_device_table(context.device()));
        VkBufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        VkBuffer buffer = VK_NULL_HANDLE;
        vk.vkCreateBuffer(context.device().device, &info, nullptr, &buffer);
        vk.vkDestroyBuffer(context.device().device, buffer, nullptr);
        CHECK(context.validation_message_count() > 0);
    }
}

} // namespace geodisk::test
