/* Records a sampling job into command buffers of this program, in one buffer of its own, and reads
 * the samples back. Needs libgeodisk and the Vulkan loader:
 *
 *     cc record.c $(pkg-config --cflags --libs geodisk vulkan)
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <geodisk/geodisk.h>
#include <vulkan/vulkan.h>

#define ROUNDS 4 /* In each command buffer. */

static void fail(const char *what, const char *message) {
    fprintf(stderr, "%s: %s\n", what, message);
    exit(EXIT_FAILURE);
}

static void check(VkResult result, const char *what) {
    if (result != VK_SUCCESS) {
        fail(what, "failed");
    }
}

/* A device with one queue for compute. */
struct gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    uint32_t family;
};

static struct gpu make_gpu(void) {
    struct gpu gpu = {0};
    VkApplicationInfo app = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo instance = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instance.pApplicationInfo = &app;
    check(vkCreateInstance(&instance, NULL, &gpu.instance), "vkCreateInstance");
    uint32_t count = 1; /* The first will do. */
    const VkResult listed = vkEnumeratePhysicalDevices(gpu.instance, &count, &gpu.physical);
    if (count == 0 || (listed != VK_SUCCESS && listed != VK_INCOMPLETE)) {
        fail("vkEnumeratePhysicalDevices", "no device");
    }
    geodisk_device_info info = GEODISK_INIT(geodisk_device_info);
    geodisk_error error = GEODISK_INIT(geodisk_error);
    if (geodisk_query_device((void (*)(void))vkGetInstanceProcAddr, gpu.instance, gpu.physical,
                             &info, &error)) {
        fail("geodisk_query_device", error.message);
    }
    if (!info.is_usable) {
        fail(info.name, info.reasons);
    }
    gpu.family = info.compute_queue_family;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = gpu.family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo device = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    check(vkCreateDevice(gpu.physical, &device, NULL, &gpu.device), "vkCreateDevice");
    vkGetDeviceQueue(gpu.device, gpu.family, 0, &gpu.queue);
    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = gpu.family;
    check(vkCreateCommandPool(gpu.device, &pool, NULL, &gpu.pool), "vkCreateCommandPool");
    return gpu;
}

static void destroy_gpu(struct gpu *gpu) {
    vkDestroyCommandPool(gpu->device, gpu->pool, NULL);
    vkDestroyDevice(gpu->device, NULL);
    vkDestroyInstance(gpu->instance, NULL);
}

/* A buffer with memory of its own. */
struct buffer {
    VkBuffer handle;
    VkDeviceMemory memory;
    unsigned char *mapped; /* NULL where the host does not see it. */
};

static struct buffer make_buffer(const struct gpu *gpu, uint64_t bytes, VkBufferUsageFlags usage,
                                 VkMemoryPropertyFlags wanted) {
    struct buffer buffer = {0};
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = usage;
    check(vkCreateBuffer(gpu->device, &info, NULL, &buffer.handle), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu->device, buffer.handle, &needs);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(gpu->physical, &memory);
    uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           (!(needs.memoryTypeBits & 1u << type) ||
            (memory.memoryTypes[type].propertyFlags & wanted) != wanted)) {
        ++type;
    }
    if (type == memory.memoryTypeCount) {
        fail("memory", "no type of memory fits");
    }
    VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = type;
    check(vkAllocateMemory(gpu->device, &allocate, NULL, &buffer.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(gpu->device, buffer.handle, buffer.memory, 0), "vkBindBufferMemory");
    if (wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
        void *mapped = NULL;
        check(vkMapMemory(gpu->device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
        buffer.mapped = mapped;
    }
    return buffer;
}

static void destroy_buffer(const struct gpu *gpu, struct buffer *buffer) {
    vkDestroyBuffer(gpu->device, buffer->handle, NULL);
    vkFreeMemory(gpu->device, buffer->memory, NULL);
}

static VkCommandBuffer begin(const struct gpu *gpu) {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkCommandBufferAllocateInfo allocate = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = gpu->pool;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(gpu->device, &allocate, &commands), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
    return commands;
}

/* An engine has frames in flight here; this program waits for each. */
static void submit(const struct gpu *gpu, VkCommandBuffer commands) {
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkSubmitInfo info = {VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    check(vkQueueSubmit(gpu->queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(gpu->queue), "vkQueueWaitIdle");
    vkFreeCommandBuffers(gpu->device, gpu->pool, 1, &commands);
}

/* Makes what was written before visible to all that comes after. */
static void barrier(VkCommandBuffer commands) {
    VkMemoryBarrier all = {VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    all.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    all.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &all, 0, NULL, 0, NULL);
}

static void copy(VkCommandBuffer commands, VkBuffer from, uint64_t at, VkBuffer to,
                 uint64_t offset, uint64_t bytes) {
    const VkBufferCopy region = {at, offset, bytes};
    vkCmdCopyBuffer(commands, from, to, 1, &region);
}

static geodisk_domain *make_domain(void) {
    static const double positions[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    static const uint32_t indices[] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    geodisk_mesh_params shape = GEODISK_INIT(geodisk_mesh_params);
    shape.positions = positions;
    shape.vertex_count = 4;
    shape.indices = indices;
    shape.face_count = 4;
    geodisk_surface_params params = GEODISK_INIT(geodisk_surface_params);
    params.min_distance = 0.2;
    params.seed = 7;
    geodisk_error error = GEODISK_INIT(geodisk_error);
    geodisk_mesh *mesh = NULL;
    geodisk_domain *domain = NULL;
    if (geodisk_mesh_create(&shape, &mesh, &error) ||
        geodisk_domain_surface(mesh, &params, &domain, &error)) {
        fail("geodisk", error.message);
    }
    geodisk_mesh_release(mesh); /* The domain keeps what it needs. */
    return domain;
}

int main(void) {
    struct gpu gpu = make_gpu();
    geodisk_error error = GEODISK_INIT(geodisk_error);
    geodisk_vulkan_device lent = GEODISK_INIT(geodisk_vulkan_device);
    lent.instance = gpu.instance;
    lent.physical_device = gpu.physical;
    lent.device = gpu.device;
    lent.queue = gpu.queue;
    lent.queue_family = gpu.family;
    lent.get_instance_proc_addr = (void (*)(void))vkGetInstanceProcAddr;
    geodisk_device *device = NULL;
    geodisk_job *job = NULL;
    geodisk_domain *domain = make_domain();
    if (geodisk_device_borrow(&lent, &device, &error) ||
        geodisk_job_create(device, domain, NULL, &job, &error)) {
        fail("geodisk", error.message);
    }

    /* All of the job in one buffer, and one that the host sees. */
    geodisk_buffer_range ranges[GEODISK_BUFFERS];
    uint64_t bytes = 0;
    geodisk_job_lay_out(job, 0, 0, ranges, &bytes, &error);
    struct buffer memory =
        make_buffer(&gpu, bytes, GEODISK_BUFFER_USAGE, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    struct buffer host = make_buffer(
        &gpu, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (geodisk_job_lay_out(job, (uint64_t)memory.handle, 0, ranges, &bytes, &error) ||
        geodisk_job_bind(job, ranges, &error)) {
        fail("geodisk", error.message);
    }

    /* The mesh, once. */
    VkCommandBuffer commands = begin(&gpu);
    for (uint32_t i = 0; i < GEODISK_BUFFERS; ++i) {
        geodisk_buffer_need need = GEODISK_INIT(geodisk_buffer_need);
        geodisk_job_need(job, i, &need, &error);
        if (need.upload_bytes > 0) {
            if (geodisk_job_upload(job, i, host.mapped + ranges[i].offset,
                                   (size_t)need.upload_bytes, &error)) {
                fail("geodisk_job_upload", error.message);
            }
            copy(commands, host.handle, ranges[i].offset, memory.handle, ranges[i].offset,
                 need.upload_bytes);
        }
    }
    barrier(commands);
    submit(&gpu, commands);

    /* Go on with the next step until there is none. */
    const geodisk_buffer_range control = ranges[GEODISK_CONTROL_BUFFER];
    geodisk_buffer_need need = GEODISK_INIT(geodisk_buffer_need);
    geodisk_job_need(job, GEODISK_CONTROL_BUFFER, &need, &error);
    geodisk_advice advice = GEODISK_INIT(geodisk_advice);
    while (advice.next != GEODISK_COMPLETE) {
        if (advice.next == GEODISK_LARGER_POOL || advice.next == GEODISK_LARGER_SAMPLES ||
            advice.next == GEODISK_START_OVER) {
            fail("geodisk", "a program would make larger buffers here, and bind them");
        }
        commands = begin(&gpu);
        if (geodisk_job_record(job, commands, advice.next,
                               advice.next == GEODISK_GO_ON ? ROUNDS : 0, NULL, &error)) {
            fail("geodisk_job_record", error.message);
        }
        barrier(commands);
        copy(commands, memory.handle, control.offset, host.handle, 0, need.read_bytes);
        barrier(commands);
        submit(&gpu, commands);
        if (geodisk_job_advance(job, host.mapped, (size_t)need.read_bytes, &advice, &error)) {
            fail("geodisk_job_advance", error.message);
        }
    }

    /* The samples, in dart order. */
    commands = begin(&gpu);
    copy(commands, memory.handle, ranges[GEODISK_SAMPLES_BUFFER].offset, host.handle, 0,
         advice.ready * sizeof(geodisk_sample_record));
    barrier(commands);
    submit(&gpu, commands);
    printf("%u samples\n", (unsigned)advice.ready);
    for (uint32_t i = 0; i < advice.ready; ++i) {
        geodisk_sample_record sample;
        memcpy(&sample, host.mapped + i * sizeof sample, sizeof sample);
        printf("%u %g %g\n", (unsigned)sample.face, sample.weight1, sample.weight2);
    }

    geodisk_job_release(job);
    geodisk_domain_release(domain);
    geodisk_device_release(device);
    destroy_buffer(&gpu, &host);
    destroy_buffer(&gpu, &memory);
    destroy_gpu(&gpu);
    return EXIT_SUCCESS;
}
