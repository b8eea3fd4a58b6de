// Drawing on a device whose calls fail, or that never answers: an error that names the call,
// nothing left behind, and pictures as before from then on.
#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>

#include "embed/device_spy.hpp"
#include "picture/gpu.hpp"
#include "picture/picture.hpp"
#include "picture/scene.hpp"
#include "picture/surface_content.hpp"
#include "program/failure.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

using tools::ExitCode;
using tools::UserError;

/// All calls that return a result.
constexpr const char* kFallibleInPictures[] = {"vkCreateCommandPool",
                                               "vkAllocateCommandBuffers",
                                               "vkCreateFence",
                                               "vkCreateBuffer",
                                               "vkAllocateMemory",
                                               "vkBindBufferMemory",
                                               "vkMapMemory",
                                               "vkCreateImage",
                                               "vkBindImageMemory",
                                               "vkCreateImageView",
                                               "vkCreateRenderPass",
                                               "vkCreateFramebuffer",
                                               "vkCreateShaderModule",
                                               "vkCreateDescriptorSetLayout",
                                               "vkCreateDescriptorPool",
                                               "vkAllocateDescriptorSets",
                                               "vkCreatePipelineLayout",
                                               "vkCreateGraphicsPipelines",
                                               "vkResetCommandPool",
                                               "vkBeginCommandBuffer",
                                               "vkEndCommandBuffer",
                                               "vkResetFences",
                                               "vkQueueSubmit"};

/// A picture of disks on a cube, drawn through the spy.
class Easel {
  public:
    Easel() : context_(open()), spy(context_.device().get_instance_proc_addr) {
        tools::picture::SurfaceContent content = tools::picture::make_surface_content(
            mesh_, {{0, 0.25, 0.25, 0.3}, {5, 0.5, 0.25, 0.3}}, tools::picture::Style::disks, {});
        content_ = std::move(content);
        params_.width = params_.height = 32;
        params_.views = {tools::picture::View{30, 20}};
    }

    std::vector<std::uint8_t>
    draw(std::chrono::nanoseconds stall_limit = tools::picture::Gpu::kStallLimit) {
        DeviceRefs device = context_.device();
        device.get_instance_proc_addr = &DeviceSpy::get_instance_proc_addr;
        const tools::picture::Gpu gpu(device, context_.queue(), stall_limit);
        return draw_picture(gpu, {scene_, content_.table, content_.samples}, params_, {})
            .pixels.rgba;
    }

  private:
    static Context open() {
        ContextOptions options;
        options.graphics = true;
        Result<Context> context = Context::create(options);
        REQUIRE(context);
        return std::move(*context);
    }

    Context context_;
    TestMesh cube_ = builtin("cube", 2);
    PreparedMesh mesh_ = prepared(cube_);
    tools::picture::Scene scene_ = tools::picture::make_scene(cube_.positions, 3, cube_.triangles);
    tools::picture::SurfaceContent content_;
    tools::picture::PictureParams params_;

  public:
    DeviceSpy spy;
};

} // namespace

TEST_CASE("no call that fails while drawing leaks or goes unnamed") {
    Easel easel;
    const std::vector<std::uint8_t> expected = easel.draw();
    CHECK(easel.spy.alive() == "");
    for (const char* const function : kFallibleInPictures) {
        CAPTURE(function);
        std::uint32_t number = 0;
        for (;; ++number) {
            CAPTURE(number);
            easel.spy.fail(function, number, VK_ERROR_OUT_OF_DEVICE_MEMORY);
            bool has_failed = false;
            try {
                const std::vector<std::uint8_t> drawn = easel.draw();
                CHECK(drawn == expected);
            } catch (const UserError& error) {
                has_failed = true;
                CHECK(error.code() == ExitCode::out_of_memory);
                CHECK(std::string(error.what()).find(function) != std::string::npos);
            }
            CHECK(easel.spy.alive() == "");
            CHECK(easel.spy.strangers() == 0);
            const bool fired = easel.spy.end_of_fault();
            CHECK(fired == has_failed);
            if (!fired) {
                break;
            }
        }
        CHECK(number > 0);
    }
    CHECK(easel.draw() == expected);
}

TEST_CASE("a device that is lost while drawing is an error") {
    Easel easel;
    for (const char* const function : {"vkQueueSubmit", "vkWaitForFences"}) {
        easel.spy.fail(function, 0, VK_ERROR_DEVICE_LOST);
        try {
            easel.draw();
            FAIL("it draws on");
        } catch (const UserError& error) {
            CHECK(error.code() == ExitCode::internal);
            CHECK(std::string(error.what()).find("lost") != std::string::npos);
        }
        CHECK(easel.spy.end_of_fault());
        CHECK(easel.spy.alive() == "");
    }
}

TEST_CASE("a wait without memory goes on while drawing") {
    Easel easel;
    const std::vector<std::uint8_t> expected = easel.draw();
    easel.spy.fail("vkWaitForFences", 0, VK_ERROR_OUT_OF_HOST_MEMORY);
    CHECK(easel.draw() == expected);
    CHECK(easel.spy.end_of_fault());
}

TEST_CASE("a device that never answers is given up while drawing, with all it may use") {
    Easel easel;
    easel.spy.never_signal = true;
    try {
        easel.draw(std::chrono::milliseconds(50));
        FAIL("it draws on");
    } catch (const UserError& error) {
        CHECK(error.code() == ExitCode::internal);
        CHECK(std::string(error.what()).find("stopped responding") != std::string::npos);
    }
    CHECK(easel.spy.alive().find("vkDestroyFence") != std::string::npos);
    CHECK(easel.spy.alive().find("vkFreeMemory") != std::string::npos);
    easel.spy.destroy_what_is_alive();
}

} // namespace geodisk::test
