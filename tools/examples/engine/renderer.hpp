// Draws the surface and a disc for each sample into an image, and reads that back at the end.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu.hpp"

namespace engine {

struct SurfaceDraw {
    geodisk::BufferRange vertices, indices;
    std::uint32_t index_count;
};

class Renderer {
  public:
    static constexpr std::uint32_t kWidth = 960, kHeight = 720;

    /// Vertices are interleaved: position, then normal. `placed` is bound once.
    Renderer(const Gpu& gpu, const geodisk::BufferRange& placed);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    ~Renderer();

    /// Records the drawing. The number of discs is known to the device alone.
    void record(VkCommandBuffer commands, const SurfaceDraw& surface,
                const geodisk::BufferRange& arguments, const glm::mat4& to_clip) const;
    /// The image as it is then, four bytes a pixel.
    void record_read(VkCommandBuffer commands, const geodisk::BufferRange& to) const;

  private:
    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
    };
    Image create_image(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) const;
    void destroy_image(const Image& image) const;
    void create_render_pass();
    void create_layout(const geodisk::BufferRange& placed);
    VkPipeline create_pipeline(const std::vector<std::uint32_t>& vertex, bool has_vertices) const;

    const Gpu& gpu_;
    Image color_, depth_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline surface_ = VK_NULL_HANDLE, discs_ = VK_NULL_HANDLE;
};

} // namespace engine
