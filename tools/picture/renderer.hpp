// Draws a surface and the disks on it, offscreen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "picture/gpu.hpp"
#include "picture/scene.hpp"
#include "picture/view.hpp"
#include "picture/window_table.hpp"
#include "picture_records.h"

namespace geodisk::tools::picture {

/// Subject to draw, a kDraw constant of picture_records.h, and the end of its scale, as PushRec has
/// it.
struct DrawKind {
    std::uint32_t kind = kDrawDisks;
    float high = 1;
    bool cuts = false; ///< As PushRec::cuts.
};

/// Content to draw. Corners of the scene are those of the table's faces.
struct Content {
    const Scene& scene;
    const WindowTable& table;
    std::span<const SampleRec> samples;
    std::span<const BallRec> balls = {};
    double ball_distance = 0; ///< Minimum distance of the samples that are balls, in mesh units.
    float largest_value = 0;  ///< Of the corners, where these are drawn in place of samples.
};

/// Holds a scene on the device. All members throw UserError.
class Renderer {
  public:
    static constexpr std::uint32_t kMaxPixels = 1536; ///< Along each side.
    /// Windows that one place may be lit by: lavapipe ends loops of 65,535 without a word.
    static constexpr std::uint32_t kMaxInCell = 60000;

    /// `gpu` must outlive the object, `content` need not.
    Renderer(const Gpu& gpu, const Content& content);

    /// Draws what `to_clip` shows of the scene, and gives the pixels, row by row from the top: red,
    /// green and blue as sRGB encodes them and 255, or four times 0 where nothing is. They are
    /// there until the next call.
    std::span<const std::uint8_t> draw(const DrawKind& what, const Camera& camera,
                                       const glm::mat4& to_clip, std::uint32_t width,
                                       std::uint32_t height);

  private:
    /// Faces whose buffers fit the device's bindings.
    struct Chunk {
        std::uint32_t corners;
        Buffer buffers[4]; ///< Bindings 0 to 3.
        VkDescriptorSet set;
    };
    enum class Pass { depth, color_after_depth, color_and_depth };
    using Pipeline = Handle<VkPipeline, &Functions::vkDestroyPipeline>;

    void make_chunks(const Scene& scene, const WindowTable& table);
    void make_targets();
    void make_layout(std::size_t chunks);
    void describe(Chunk& chunk) const;
    Pipeline make_surface_pipeline(Pass of, std::uint32_t kind) const;
    Pipeline make_pipeline(VkShaderModule vertex, VkShaderModule fragment, Pass of,
                           std::uint32_t kind) const;
    VkPipeline pipeline_of(std::uint32_t kind);

    const Gpu& gpu_;
    Buffer samples_, balls_;
    std::uint32_t ball_count_;
    std::vector<Chunk> chunks_;
    Image color_, depth_;
    Buffer read_back_;
    Handle<VkRenderPass, &Functions::vkDestroyRenderPass> pass_;
    Handle<VkFramebuffer, &Functions::vkDestroyFramebuffer> framebuffer_;
    Handle<VkDescriptorSetLayout, &Functions::vkDestroyDescriptorSetLayout> set_layout_;
    Handle<VkPipelineLayout, &Functions::vkDestroyPipelineLayout> layout_;
    Handle<VkDescriptorPool, &Functions::vkDestroyDescriptorPool> pool_;
    Pipeline depth_alone_, ball_pipeline_;
    std::map<std::uint32_t, Pipeline> pipelines_; ///< By kind.
};

} // namespace geodisk::tools::picture
