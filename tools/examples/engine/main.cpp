// A small engine: every frame samples a little further and draws what there is so far. The samples
// never pass through the host; how many there are, only the device knows.
//
//   engine [--validate] IMAGE.png
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

#include "gpu.hpp"
#include "renderer.hpp"
#include "sampling.hpp"

namespace {

using namespace engine;

constexpr VkDeviceSize kGeometryBytes = VkDeviceSize{4} << 20;
constexpr VkDeviceSize kDeviceBytes = VkDeviceSize{64} << 20;
constexpr VkDeviceSize kHostBytes = VkDeviceSize{16} << 20;
constexpr double kSamples = 3000;
constexpr std::uint32_t kMaxFrames = 10000;

struct Vertex {
    glm::vec3 position, normal;
};

struct Torus {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
};

Torus make_torus(std::uint32_t around, std::uint32_t across) {
    Torus torus;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            const float u =
                glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(around);
            const float v =
                glm::two_pi<float>() * static_cast<float>(k) / static_cast<float>(across);
            const glm::vec3 out(std::cos(u), std::sin(u), 0);
            const glm::vec3 normal = std::cos(v) * out + std::sin(v) * glm::vec3(0, 0, 1);
            torus.vertices.push_back({out + 0.4f * normal, normal});
            const std::uint32_t i1 = (i + 1) % around, k1 = (k + 1) % across;
            const std::uint32_t quad[] = {i * across + k, i1 * across + k, i1 * across + k1,
                                          i * across + k1};
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
                torus.indices.push_back(quad[corner]);
            }
        }
    }
    return torus;
}

template <class T>
void upload(VkCommandBuffer commands, const std::vector<T>& from, Block& host,
            const geodisk::BufferRange& to) {
    const geodisk::BufferRange staged = host.cut(from.size() * sizeof(T));
    std::memcpy(host.bytes(staged).data(), from.data(), from.size() * sizeof(T));
    copy(commands, staged, to, staged.size);
}

glm::mat4 camera(std::uint32_t frame) {
    const float angle = 0.6f + 0.002f * static_cast<float>(frame);
    glm::mat4 to_clip = glm::perspectiveRH_ZO(0.7f, 4.0f / 3.0f, 0.5f, 10.0f);
    to_clip[1][1] = -to_clip[1][1]; // Vulkan's y goes down.
    return to_clip * glm::lookAt(glm::vec3(3 * std::cos(angle), 3 * std::sin(angle), 2.6f),
                                 glm::vec3(0), glm::vec3(0, 0, 1));
}

/// Runs the example. Returns true if the validation layer had nothing to report.
bool run(bool validate, const char* path) {
    Gpu gpu(validate);
    const Torus torus = make_torus(192, 64);

    // The mesh is read where it lies: interleaved vertices, as they are drawn.
    const geodisk::MeshView view{
        {&torus.vertices[0].position.x, torus.vertices.size(), sizeof(Vertex)}, torus.indices};
    const auto mesh = take(geodisk::PreparedMesh::prepare(view));
    geodisk::SampleParams params;
    params.min_distance = geodisk::distance_for_count(mesh.statistics().area, kSamples);
    const auto domain = take(geodisk::Domain::surface(mesh, params));

    // Vertices and indices are storage as well, where geodisk reads them.
    Block geometry(gpu, kGeometryBytes,
                   VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                   VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    Block device(gpu, kDeviceBytes, geodisk::kWorkspaceUsage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    Block host(gpu, kHostBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    const SurfaceDraw surface{geometry.cut(torus.vertices.size() * sizeof(Vertex)),
                              geometry.cut(torus.indices.size() * 4),
                              static_cast<std::uint32_t>(torus.indices.size())};
    Sampling sampling(gpu, domain,
                      {surface.vertices, surface.indices, sizeof(Vertex), 0, sizeof(glm::vec3)},
                      device, host);
    Renderer renderer(gpu, sampling.placed());
    const geodisk::BufferRange image =
        host.cut(VkDeviceSize{4} * Renderer::kWidth * Renderer::kHeight);
    Frames frames(gpu);

    std::uint32_t frame = 0;
    for (bool is_last = false; !is_last; ++frame) {
        const VkCommandBuffer commands = frames.begin();
        if (frame == 0) {
            upload(commands, torus.vertices, host, surface.vertices);
            upload(commands, torus.indices, host, surface.indices);
            barrier(commands, {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT},
                    {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                     VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT});
            sampling.record_upload(commands);
        }
        sampling.record(commands, frames.turn());
        is_last = sampling.is_complete();
        renderer.record(commands, surface, sampling.arguments(), camera(frame));
        if (is_last) {
            renderer.record_read(commands, image);
        }
        frames.submit();
        if (frame == kMaxFrames) {
            throw std::runtime_error("the samples take too many frames");
        }
    }
    frames.wait_for_all();
    if (stbi_write_png(path, Renderer::kWidth, Renderer::kHeight, 4, host.bytes(image).data(), 0) ==
        0) {
        throw std::runtime_error(std::string(path) + " cannot be written");
    }
    std::printf("%u frames on %s: %s\n", frame, gpu.report().name.c_str(), path);
    return gpu.complaints() == 0;
}

} // namespace

int main(int argc, char** argv) try {
    const bool validate = argc == 3 && std::string(argv[1]) == "--validate";
    if (argc != (validate ? 3 : 2)) {
        std::fprintf(stderr, "usage: engine [--validate] IMAGE.png\n");
        return 2;
    }
    return run(validate, argv[argc - 1]) ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "engine: %s\n", error.what());
    return 1;
}
