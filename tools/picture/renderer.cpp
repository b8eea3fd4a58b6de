#include "picture/renderer.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "program/failure.hpp"
#include "program/human_text.hpp"

#include "ball_frag.spv.inc"
#include "ball_vert.spv.inc"
#include "surface_frag.spv.inc"
#include "surface_vert.spv.inc"

namespace geodisk::tools::picture {
namespace {

constexpr VkFormat kColor = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkDeviceSize kPixelBytes = 4;
constexpr std::uint32_t kBindings = 6;
constexpr std::uint32_t kBallCorners = 6;

/// Returns true if colouring what may be hidden costs less than finding out first what is seen.
bool is_cheap(std::uint32_t kind) {
    return kind == kDrawArea || kind == kDrawFrame;
}

template <class T>
std::span<const std::byte> bytes_of(std::span<const T> values) {
    return std::as_bytes(values);
}

using Module = Handle<VkShaderModule, &Functions::vkDestroyShaderModule>;

template <std::size_t kSize>
Module make_module(const Gpu& gpu, const std::uint32_t (&code)[kSize]) {
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = sizeof code;
    info.pCode = code;
    VkShaderModule module = VK_NULL_HANDLE;
    check(gpu.vk().vkCreateShaderModule(gpu.device(), &info, nullptr, &module),
          "vkCreateShaderModule");
    return {gpu, module};
}

/// Returns where each chunk begins, and the end: as many faces as fit bindings of `most` bytes.
std::vector<std::uint32_t> chunk_bounds(const WindowTable& table, VkDeviceSize most) {
    const auto face_count = static_cast<std::uint32_t>(table.faces.size());
    const auto end_of = [&](std::uint32_t face) {
        const FaceRec& rec = table.faces[face];
        return rec.first_cell + rec.columns * rec.rows;
    };
    std::vector<std::uint32_t> bounds{0};
    for (std::uint32_t face = 0; face < face_count; ++face) {
        const std::uint32_t first = bounds.back();
        const std::uint32_t first_cell = table.faces[first].first_cell;
        const std::uint32_t cells = end_of(face) - first_cell;
        const VkDeviceSize windows =
            table.starts[end_of(face)] - table.starts[std::size_t{first_cell}];
        const VkDeviceSize faces = face + 1 - first;
        if (std::max({faces * 3 * sizeof(CornerRec), (VkDeviceSize{cells} + 1) * 4,
                      windows * sizeof(WindowRec)}) <= most) {
            continue;
        }
        if (faces == 1) {
            throw UserError(ExitCode::out_of_memory,
                            "face " + std::to_string(face) +
                                " alone is lit by more windows than the device binds at once");
        }
        bounds.push_back(face);
        --face; // Again, as the first of its chunk.
    }
    bounds.push_back(face_count);
    return bounds;
}

void check_cells(const WindowTable& table) {
    for (std::size_t cell = 0; cell + 1 < table.starts.size(); ++cell) {
        const std::uint32_t windows = table.starts[cell + 1] - table.starts[cell];
        if (windows > Renderer::kMaxInCell) {
            throw UserError(ExitCode::out_of_memory,
                            "one place of the surface is lit by " + grouped(windows) +
                                " windows; a picture takes " + grouped(Renderer::kMaxInCell) +
                                ": a shorter reach gives fewer");
        }
    }
}

void check_bindings(const Gpu& gpu, const Content& content) {
    const std::size_t largest = std::max(content.samples.size_bytes(), content.balls.size_bytes());
    if (largest > gpu.limits().maxStorageBufferRange) {
        throw UserError(ExitCode::out_of_memory, "the samples take " + size_text(largest) +
                                                     ", and the device binds at most " +
                                                     size_text(gpu.limits().maxStorageBufferRange));
    }
}

} // namespace

Renderer::Renderer(const Gpu& gpu, const Content& content)
    : gpu_(gpu), samples_(make_storage(gpu, bytes_of(content.samples))),
      balls_(make_storage(gpu, bytes_of(content.balls))),
      ball_count_(static_cast<std::uint32_t>(content.balls.size())) {
    check_cells(content.table);
    check_bindings(gpu, content);
    make_targets();
    make_chunks(content.scene, content.table);
    depth_alone_ = make_surface_pipeline(Pass::depth, 0);
    if (ball_count_ > 0) {
        const Module vertex = make_module(gpu_, k_ball_vert_spirv);
        const Module fragment = make_module(gpu_, k_ball_frag_spirv);
        ball_pipeline_ = make_pipeline(vertex.get(), fragment.get(), Pass::color_and_depth, 0);
    }
}

void Renderer::make_chunks(const Scene& scene, const WindowTable& table) {
    const std::vector<std::uint32_t> bounds =
        chunk_bounds(table, gpu_.limits().maxStorageBufferRange);
    make_layout(bounds.size() - 1);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        const std::uint32_t first = bounds[i];
        const std::uint32_t count = bounds[i + 1] - first;
        std::vector<FaceRec> faces(table.faces.begin() + first,
                                   table.faces.begin() + first + count);
        const std::uint32_t first_cell = faces.front().first_cell;
        const std::uint32_t end_cell =
            faces.back().first_cell + faces.back().columns * faces.back().rows;
        for (FaceRec& face : faces) {
            face.first_cell -= first_cell;
        }
        std::vector<std::uint32_t> starts(table.starts.begin() + first_cell,
                                          table.starts.begin() + end_cell + 1);
        const std::uint32_t first_window = starts.front();
        for (std::uint32_t& start : starts) {
            start -= first_window;
        }
        const auto corners =
            std::span(scene.corners).subspan(std::size_t{3} * first, std::size_t{3} * count);
        const auto windows = std::span(table.windows).subspan(first_window, starts.back());
        Chunk& chunk = chunks_.emplace_back();
        chunk.corners = 3 * count;
        chunk.buffers[0] = make_storage(gpu_, std::as_bytes(corners));
        chunk.buffers[1] = make_storage(gpu_, bytes_of(std::span<const FaceRec>(faces)));
        chunk.buffers[2] = make_storage(gpu_, bytes_of(std::span<const std::uint32_t>(starts)));
        chunk.buffers[3] = make_storage(gpu_, std::as_bytes(windows));
        describe(chunk);
    }
}

void Renderer::make_targets() {
    const VkExtent2D size{kMaxPixels, kMaxPixels};
    color_ = Image(gpu_, kColor, size,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                   VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ = Image(gpu_, gpu_.depth_format(), size, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                   VK_IMAGE_ASPECT_DEPTH_BIT);
    read_back_ =
        Buffer(gpu_, kPixelBytes * kMaxPixels * kMaxPixels, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true);

    VkAttachmentDescription attachments[2]{};
    attachments[0].format = kColor;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    attachments[1].format = gpu_.depth_format();
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    for (VkAttachmentDescription& attachment : attachments) {
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    }
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    // Draws follow each other in the same images, each of which is read before the next.
    constexpr VkPipelineStageFlags kStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                             VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                             VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkAccessFlags kWrites =
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, kStages | VK_PIPELINE_STAGE_TRANSFER_BIT, kStages, kWrites,
         kWrites | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0},
        {0, VK_SUBPASS_EXTERNAL, kStages, VK_PIPELINE_STAGE_TRANSFER_BIT, kWrites,
         VK_ACCESS_TRANSFER_READ_BIT, 0}};
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = dependencies;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreateRenderPass(gpu_.device(), &info, nullptr, &pass), "vkCreateRenderPass");
    pass_ = {gpu_, pass};

    const VkImageView views[] = {color_.view(), depth_.view()};
    auto frame = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    frame.renderPass = pass;
    frame.attachmentCount = 2;
    frame.pAttachments = views;
    frame.width = kMaxPixels;
    frame.height = kMaxPixels;
    frame.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreateFramebuffer(gpu_.device(), &frame, nullptr, &framebuffer),
          "vkCreateFramebuffer");
    framebuffer_ = {gpu_, framebuffer};
}

void Renderer::make_layout(std::size_t chunks) {
    VkDescriptorSetLayoutBinding bindings[kBindings];
    for (std::uint32_t i = 0; i < kBindings; ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    auto set_info = structure<VkDescriptorSetLayoutCreateInfo>(
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_info.bindingCount = kBindings;
    set_info.pBindings = bindings;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreateDescriptorSetLayout(gpu_.device(), &set_info, nullptr, &set_layout),
          "vkCreateDescriptorSetLayout");
    set_layout_ = {gpu_, set_layout};

    const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                    sizeof(PushRec)};
    auto info =
        structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreatePipelineLayout(gpu_.device(), &info, nullptr, &layout),
          "vkCreatePipelineLayout");
    layout_ = {gpu_, layout};

    const auto sets = static_cast<std::uint32_t>(chunks);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBindings * sets};
    auto pool_info =
        structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool_info.maxSets = sets;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreateDescriptorPool(gpu_.device(), &pool_info, nullptr, &pool),
          "vkCreateDescriptorPool");
    pool_ = {gpu_, pool};
}

void Renderer::describe(Chunk& chunk) const {
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    auto allocate =
        structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pool_.get();
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &set_layout;
    check(gpu_.vk().vkAllocateDescriptorSets(gpu_.device(), &allocate, &chunk.set),
          "vkAllocateDescriptorSets");
    VkDescriptorBufferInfo buffers[kBindings];
    VkWriteDescriptorSet writes[kBindings];
    for (std::uint32_t i = 0; i < kBindings; ++i) {
        const Buffer& buffer = i < 4 ? chunk.buffers[i] : i == 4 ? samples_ : balls_;
        buffers[i] = {buffer.get(), 0, VK_WHOLE_SIZE};
        writes[i] = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        writes[i].dstSet = chunk.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &buffers[i];
    }
    gpu_.vk().vkUpdateDescriptorSets(gpu_.device(), kBindings, writes, 0, nullptr);
}

Renderer::Pipeline Renderer::make_surface_pipeline(Pass of, std::uint32_t kind) const {
    const Module vertex = make_module(gpu_, k_surface_vert_spirv);
    const Module fragment = make_module(gpu_, k_surface_frag_spirv);
    return make_pipeline(vertex.get(), fragment.get(), of, kind);
}

Renderer::Pipeline Renderer::make_pipeline(VkShaderModule vertex, VkShaderModule fragment, Pass of,
                                           std::uint32_t kind) const {
    const VkSpecializationMapEntry entry{0, 0, sizeof kind};
    const VkSpecializationInfo constants{1, &entry, sizeof kind, &kind};
    VkPipelineShaderStageCreateInfo stages[2]{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex;
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment;
    stages[1].pSpecializationInfo = &constants;

    const auto input = structure<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    auto assembly = structure<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto view = structure<VkPipelineViewportStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    view.viewportCount = 1;
    view.scissorCount = 1;
    auto raster = structure<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.lineWidth = 1;
    auto multisample = structure<VkPipelineMultisampleStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    auto depth = structure<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = of == Pass::color_after_depth ? VK_FALSE : VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    VkPipelineColorBlendAttachmentState blend{};
    blend.colorWriteMask = of == Pass::depth ? 0u : 0xfu;
    auto blending = structure<VkPipelineColorBlendStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blending.attachmentCount = 1;
    blending.pAttachments = &blend;
    const VkDynamicState dynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamics = structure<VkPipelineDynamicStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamics.dynamicStateCount = 2;
    dynamics.pDynamicStates = dynamic;
    auto info =
        structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = of == Pass::depth ? 1 : 2;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &view;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.pDynamicState = &dynamics;
    info.layout = layout_.get();
    info.renderPass = pass_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(gpu_.vk().vkCreateGraphicsPipelines(gpu_.device(), VK_NULL_HANDLE, 1, &info, nullptr,
                                              &pipeline),
          "vkCreateGraphicsPipelines");
    return {gpu_, pipeline};
}

VkPipeline Renderer::pipeline_of(std::uint32_t kind) {
    auto found = pipelines_.find(kind);
    if (found == pipelines_.end()) {
        const Pass of = is_cheap(kind) ? Pass::color_and_depth : Pass::color_after_depth;
        found = pipelines_.emplace(kind, make_surface_pipeline(of, kind)).first;
    }
    return found->second.get();
}

std::span<const std::uint8_t> Renderer::draw(const DrawKind& what, const Camera& camera,
                                             const glm::mat4& to_clip, std::uint32_t width,
                                             std::uint32_t height) {
    PushRec push{};
    std::memcpy(push.to_clip, glm::value_ptr(to_clip), sizeof push.to_clip);
    push.eye_x = camera.eye.x;
    push.eye_y = camera.eye.y;
    push.eye_z = camera.eye.z;
    push.light_x = camera.light.x;
    push.light_y = camera.light.y;
    push.light_z = camera.light.z;
    push.high = what.high;
    push.cuts = what.cuts ? 1 : 0;

    const VkPipeline colored = pipeline_of(what.kind);
    const Functions& vk = gpu_.vk();
    gpu_.run([&](VkCommandBuffer commands) {
        VkClearValue clear[2]{};
        clear[1].depthStencil = {1, 0};
        auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        begin.renderPass = pass_.get();
        begin.framebuffer = framebuffer_.get();
        begin.renderArea = {{0, 0}, {width, height}};
        begin.clearValueCount = 2;
        begin.pClearValues = clear;
        vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
        const VkViewport viewport{0, 0, static_cast<float>(width), static_cast<float>(height),
                                  0, 1};
        vk.vkCmdSetViewport(commands, 0, 1, &viewport);
        vk.vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
        vk.vkCmdPushConstants(commands, layout_.get(),
                              VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                              sizeof push, &push);
        for (const VkPipeline pipeline : {depth_alone_.get(), colored}) {
            if (pipeline == depth_alone_.get() && is_cheap(what.kind)) {
                continue;
            }
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            for (const Chunk& chunk : chunks_) {
                vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(),
                                           0, 1, &chunk.set, 0, nullptr);
                vk.vkCmdDraw(commands, chunk.corners, 1, 0, 0);
            }
        }
        if (ball_count_ > 0) {
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ball_pipeline_.get());
            vk.vkCmdDraw(commands, kBallCorners * ball_count_, 1, 0, 0);
        }
        vk.vkCmdEndRenderPass(commands);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {width, height, 1};
        vk.vkCmdCopyImageToBuffer(commands, color_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                  read_back_.get(), 1, &region);
        auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    });
    return {reinterpret_cast<const std::uint8_t*>(read_back_.bytes().data()),
            static_cast<std::size_t>(kPixelBytes * width * height)};
}

} // namespace geodisk::tools::picture
