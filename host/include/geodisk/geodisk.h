/* geodisk in C: random points on triangle meshes, no two closer than a minimum distance along the
 * surface.
 *
 *     geodisk_error error = {sizeof error};
 *     geodisk_device *device = NULL;
 *     geodisk_sampler *sampler = NULL;
 *     geodisk_mesh *mesh = NULL;
 *     geodisk_domain *domain = NULL;
 *     geodisk_samples *samples = NULL;
 *
 *     geodisk_mesh_params shape = {sizeof shape};           then its arrays
 *     geodisk_surface_params job = {sizeof job};
 *     job.min_distance = 0.01;
 *
 *     if (geodisk_device_open(NULL, &device, &error) ||
 *         geodisk_sampler_create(device, NULL, &sampler, &error) ||
 *         geodisk_mesh_create(&shape, &mesh, &error) ||
 *         geodisk_domain_surface(mesh, &job, &domain, &error) ||
 *         geodisk_sample(sampler, domain, NULL, NULL, &samples, &error)) {
 *         fprintf(stderr, "%s\n", error.message);
 *     }
 *
 * All functions: they return GEODISK_OK, which is 0, or a negative status, and never exit, print or
 * throw. `error` may be NULL; else it tells of the call that it was handed to, success included.
 * What a call makes is written only when it succeeds, and is the caller's, to be released once;
 * releasing NULL does nothing. There is no state but that of objects.
 *
 * Objects: those that others were made of may be released before these; the others keep what they
 * need. Devices, meshes, radii, domains and samples never change, so any number of threads may use
 * one; a sampler is for one thread at a time, and another gets GEODISK_BUSY. No object may be
 * released while a call has it.
 *
 * Structs: each begins with `struct_size`, which is to be its sizeof; all else may be 0, which is
 * the default. Programs compiled with this header go on to work with later versions of the library.
 *
 * Lengths are in mesh units, or in those of a box. Samples are the same on every device.
 * host/docs/c.md has examples; the C++ headers beside this one tell more of each function's
 * counterpart.
 */
#ifndef GEODISK_GEODISK_H
#define GEODISK_GEODISK_H

#include <stddef.h>
#include <stdint.h>

/* Marks what the library exports. */
#if !defined(_WIN32)
#define GEODISK_C_API __attribute__((visibility("default")))
#elif defined(GEODISK_C_EXPORTS)
#define GEODISK_C_API __declspec(dllexport)
#else
#define GEODISK_C_API __declspec(dllimport)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Outcomes ---------------------------------------------------------------------------------- */

/* What became of a call: GEODISK_OK, or below 0 why it failed. */
typedef int32_t geodisk_status;
enum {
    GEODISK_OK = 0,
    GEODISK_INVALID_ARGUMENT = -1,    /* A parameter is out of its range, or NULL. */
    GEODISK_MESH_REJECTED = -2,       /* The mesh cannot be sampled; `element` names the place. */
    GEODISK_DEVICE_LACKS = -3,        /* The device misses a limit or feature. */
    GEODISK_NO_DEVICE = -4,           /* No Vulkan loader, driver or device was found. */
    GEODISK_WORKSPACE_TOO_SMALL = -5, /* The bytes allowed on the device do not suffice. */
    GEODISK_OUT_OF_HOST_MEMORY = -6,
    GEODISK_OUT_OF_DEVICE_MEMORY = -7,
    GEODISK_DEVICE_LOST = -8,   /* For good: the sampler does no more. */
    GEODISK_CANCELLED = -9,     /* As asked for. */
    GEODISK_INTERNAL = -10,     /* An error of geodisk itself, or of the driver. */
    GEODISK_JOB_TOO_LARGE = -11,/* A buffer exceeds what the device can bind. */
    GEODISK_BUSY = -12          /* Another thread, or a run in progress, has the sampler. */
};

/* Of an error that concerns no one face or vertex. */
#define GEODISK_NO_ELEMENT UINT64_MAX

/* What became of a call. */
typedef struct geodisk_error {
    size_t struct_size;
    geodisk_status status;
    int32_t vk_result; /* The VkResult behind a failure, if any. */
    uint64_t element;  /* Face or vertex at fault, or GEODISK_NO_ELEMENT. */
    char message[1024];/* One line of UTF-8; empty for success. */
} geodisk_error;

/* "invalid_argument" and so on; "unknown" for what is none. */
GEODISK_C_API const char *geodisk_status_name(geodisk_status status);

/* Of the library: "major.minor.patch". */
GEODISK_C_API const char *geodisk_version(void);

/* ---- Devices ----------------------------------------------------------------------------------- */

/* A device that is ready to be sampled on, with its pipelines. */
typedef struct geodisk_device geodisk_device;

/* Where a device has no such family. */
#define GEODISK_NO_QUEUE_FAMILY UINT32_MAX

/* What is known of a Vulkan device. */
typedef struct geodisk_device_info {
    size_t struct_size;
    int32_t is_usable;
    uint32_t type; /* VkPhysicalDeviceType: 1 integrated, 2 discrete, 3 virtual, 4 CPU. */
    uint32_t vendor_id;
    uint32_t device_id;
    uint32_t api_version;
    uint32_t driver_version;
    uint32_t compute_queue_family;  /* To take a queue from, or GEODISK_NO_QUEUE_FAMILY. */
    uint32_t graphics_queue_family; /* One that draws as well, or GEODISK_NO_QUEUE_FAMILY. */
    uint64_t memory_bytes;          /* Of its largest heap of its own. */
    uint8_t uuid[16];
    char name[256];
    char driver[512];
    char reasons[1024]; /* Why it is not usable, a line each. */
} geodisk_device_info;

/* All devices of this machine. Writes the first `capacity` of them to `infos`, each with the
 * struct_size that the first one has, and how many there are to `count`. */
GEODISK_C_API geodisk_status geodisk_list_devices(geodisk_device_info *infos, size_t capacity,
                                                  size_t *count, geodisk_error *error);

/* Which device to open, and how. */
typedef struct geodisk_device_options {
    size_t struct_size;
    /* Part of its name, its index, or its UUID; NULL or "" for the best one. */
    const char *device;
    /* Not 0: with the validation layer, for development. */
    int32_t validation;
} geodisk_device_options;

/* Opens a device for geodisk alone. `options` may be NULL. */
GEODISK_C_API geodisk_status geodisk_device_open(const geodisk_device_options *options,
                                                 geodisk_device **device, geodisk_error *error);

/* Memory for a buffer, asked of the caller. Flags are VkMemoryPropertyFlags. */
typedef struct geodisk_memory_request {
    size_t struct_size;
    uint64_t buffer; /* VkBuffer, to which geodisk binds it. */
    uint64_t bytes;
    uint64_t alignment;
    uint32_t memory_types; /* Bits of those it may be of. */
    uint32_t required;     /* Host visible and coherent where the host writes or reads. */
    uint32_t preferred;    /* Better still. */
} geodisk_memory_request;

/* What the caller gives. */
typedef struct geodisk_memory_grant {
    size_t struct_size;
    uint64_t memory; /* VkDeviceMemory. */
    uint64_t offset; /* Aligned as asked. */
    void *mapped;    /* At `offset`, until freed; not NULL where the host is to see it. */
    void *allocation;/* The caller's own, for `free`. */
} geodisk_memory_grant;

/* A device and queue of the caller's, by their Vulkan handles. They must outlive all objects made
 * from them, samples aside, and geodisk destroys none of them. */
typedef struct geodisk_vulkan_device {
    size_t struct_size;
    void *instance;                         /* VkInstance. */
    void *physical_device;                  /* VkPhysicalDevice. */
    void *device;                           /* VkDevice. */
    void (*get_instance_proc_addr)(void);   /* PFN_vkGetInstanceProcAddr. */
    uint32_t api_version;                   /* The lower of the instance's and device's; 0 for 1.1. */
    uint32_t queue_family;                  /* One with compute. */
    void *queue;                            /* VkQueue. */
    uint64_t pipeline_cache;                /* VkPipelineCache, or 0. */
    int32_t memory_budget;                  /* Whether VK_EXT_memory_budget is enabled, */
    int32_t debug_utils;                    /* and VK_EXT_debug_utils. */
    /* Called around each submission, where other threads submit to the queue; else NULL. */
    void *lock_user;
    void (*lock)(void *lock_user);
    void (*unlock)(void *lock_user);
    const void *host_allocator; /* VkAllocationCallbacks, or NULL. */
    /* Where runs get the memory of their buffers, such as VMA; NULL for an allocation for each.
     * `allocate` fills `grant`, or fails as vkAllocateMemory does. */
    void *memory_user;
    int32_t (*allocate)(void *memory_user, const geodisk_memory_request *request,
                        geodisk_memory_grant *grant);
    void (*free)(void *memory_user, const geodisk_memory_grant *grant);
} geodisk_vulkan_device;

/* A device and queue of the caller's, which must outlive all that is made of them. */
GEODISK_C_API geodisk_status geodisk_device_borrow(const geodisk_vulkan_device *lent,
                                                   geodisk_device **device, geodisk_error *error);

/* Of a physical device of the caller's, before it makes a VkDevice. */
GEODISK_C_API geodisk_status geodisk_query_device(void (*get_instance_proc_addr)(void),
                                                  void *instance, void *physical_device,
                                                  geodisk_device_info *info, geodisk_error *error);

/* What is known of a device that was opened or borrowed. */
GEODISK_C_API geodisk_status geodisk_device_describe(const geodisk_device *device,
                                                     geodisk_device_info *info,
                                                     geodisk_error *error);

GEODISK_C_API void geodisk_device_release(geodisk_device *device);

/* ---- Meshes ------------------------------------------------------------------------------------ */

/* Numbers in the caller's memory. */
typedef int32_t geodisk_type;
enum { GEODISK_FLOAT64 = 0, GEODISK_FLOAT32 = 1, GEODISK_UINT32 = 2, GEODISK_UINT16 = 3 };

/* A mesh that is prepared for any number of runs. */
typedef struct geodisk_mesh geodisk_mesh;

/* A triangle mesh in the caller's memory. Faces may be oriented either way, share an edge by any
 * number, and leave borders open. */
typedef struct geodisk_mesh_params {
    size_t struct_size;
    const void *positions;      /* `dimension` coordinates for each vertex, side by side. */
    geodisk_type position_type; /* GEODISK_FLOAT64 or GEODISK_FLOAT32. */
    uint32_t dimension;         /* 2 to 8; 0 for 3. */
    size_t vertex_count;
    size_t position_stride;     /* Bytes from vertex to vertex; 0 for none between. */
    const void *indices;        /* Three vertices for each face. */
    geodisk_type index_type;    /* GEODISK_UINT32 or GEODISK_UINT16; 0 for GEODISK_UINT32. */
    size_t face_count;
    size_t index_stride;        /* Bytes from index to index; 0 for none between. */
    /* Instead of positions: lengths of each face's edges, from its first corner to the second, to
     * the third and back. */
    const double *edge_lengths;
    /* Not 0: vertices in one place become one, as do those no farther apart than weld_distance. */
    int32_t weld;
    double weld_distance;
    uint32_t most_threads;      /* To prepare with; 0 for 16. */
    /* 0: border edges that lie exactly on other border edges are joined to them, as along seams of
     * texture coordinates. Not 0: only faces that share vertices are connected. */
    int32_t keep_seams;
} geodisk_mesh_params;

/* Takes what is needed of the mesh; the caller's memory is free afterwards. */
GEODISK_C_API geodisk_status geodisk_mesh_create(const geodisk_mesh_params *params,
                                                 geodisk_mesh **mesh, geodisk_error *error);

/* A mesh as bytes for geodisk_mesh_load, without its coordinates. Writes how many to `size`, and
 * them to `bytes` where `capacity` suffices; `bytes` may be NULL. */
GEODISK_C_API geodisk_status geodisk_mesh_save(const geodisk_mesh *mesh, void *bytes,
                                               size_t capacity, size_t *size, geodisk_error *error);
/* The mesh that was saved. The bytes may come from anywhere: others are refused. */
GEODISK_C_API geodisk_status geodisk_mesh_load(const void *bytes, size_t size, geodisk_mesh **mesh,
                                               geodisk_error *error);

/* What is known of a mesh. */
typedef struct geodisk_mesh_info {
    size_t struct_size;
    uint32_t dimension; /* Of its coordinates; 0 where there are none. */
    uint64_t vertices;  /* Used by a face. */
    uint64_t faces;
    uint64_t components;
    uint64_t boundary_edges;
    uint64_t coinciding_border_edges; /* Open seams, which keep_seams leaves open. */
    uint64_t nonmanifold_edges;
    uint64_t repeated_index_faces;    /* They take no part. */
    uint64_t zero_area_faces;         /* They hold no sample. */
    uint64_t merged_vertices;         /* Vertices joined to others, by weld or along seams. */
    double area;
    double diagonal;                  /* Of the bounding box. */
    double longest_edge;
    uint64_t joined_edges;            /* Border edges joined to others along seams. */
} geodisk_mesh_info;

/* What became known of a mesh as it was prepared. */
GEODISK_C_API geodisk_status geodisk_mesh_describe(const geodisk_mesh *mesh,
                                                   geodisk_mesh_info *info, geodisk_error *error);

GEODISK_C_API void geodisk_mesh_release(geodisk_mesh *mesh);

/* Radii that vary: at each vertex a factor of 0.001 to 1, by which the radius is smaller than half
 * of min_distance; linear in each face. Two samples are as far apart as both radii together. */
typedef struct geodisk_radii geodisk_radii;

/* `factors`: one for each vertex of the mesh, of GEODISK_FLOAT64 or GEODISK_FLOAT32. Where vertices
 * are joined, the mean of theirs counts; of a mesh from geodisk_mesh_load, that of the lowest. */
GEODISK_C_API geodisk_status geodisk_radii_create(const geodisk_mesh *mesh, const void *factors,
                                                  geodisk_type type, size_t count,
                                                  geodisk_radii **radii, geodisk_error *error);

/* Radii by a density, one value for each vertex as above: 0 or positive, in any unit. Samples per
 * area come out in proportion to it, none where it is 0. */
GEODISK_C_API geodisk_status geodisk_density_create(const geodisk_mesh *mesh, const void *density,
                                                    geodisk_type type, size_t count,
                                                    geodisk_radii **radii, geodisk_error *error);

/* The least of the factors: min_distance times this is the least distance of two samples. 1 for
 * NULL. */
GEODISK_C_API double geodisk_radii_least_factor(const geodisk_radii *radii);

GEODISK_C_API void geodisk_radii_release(geodisk_radii *radii);

/* ---- Domains: what is sampled ------------------------------------------------------------------ */

/* What is sampled, and how. */
typedef struct geodisk_domain geodisk_domain;

/* By which distance. All but the first are for comparison. */
typedef int32_t geodisk_metric;
enum { GEODISK_GEODESIC = 0, GEODISK_EUCLIDEAN = 1, GEODISK_APPROXIMATE = 2 };

/* How a surface is sampled. */
typedef struct geodisk_surface_params {
    size_t struct_size;
    double min_distance; /* D > 0: no two samples are closer along the surface. */
    uint64_t seed;
    double pool_ratio;   /* Candidates per expected sample, 1 to 10,000; 0 for 20. */
    uint32_t throws;     /* Not 0: so many darts instead of candidates by pool_ratio. */
    uint32_t stop_count; /* Not 0: the first so many samples. */
    const geodisk_radii *radii; /* Of the same mesh; NULL for one radius. */
    /* By which candidates of each face are drawn, one for each face, no two alike: the same
     * triangle with the same key has the same candidates in every mesh. NULL: its index. */
    const uint32_t *face_keys;
    geodisk_metric metric; /* Those for comparison take three coordinates and no radii. */
} geodisk_surface_params;

/* One surface. */
GEODISK_C_API geodisk_status geodisk_domain_surface(const geodisk_mesh *mesh,
                                                    const geodisk_surface_params *params,
                                                    geodisk_domain **domain, geodisk_error *error);

/* One of several surfaces that are sampled as one job: an instance of a mesh. */
typedef struct geodisk_surface_part {
    size_t struct_size;
    const geodisk_mesh *mesh;
    const geodisk_surface_params *params; /* Of this one alone; no throws and no stop_count. */
    double scale;                         /* Of its lengths; 0 for 1. */
} geodisk_surface_part;

/* `parts` is an array; all have the struct_size that the first one has. Each surface gets the
 * samples that it would get by itself. */
GEODISK_C_API geodisk_status geodisk_domain_surfaces(const geodisk_surface_part *parts,
                                                     size_t count, geodisk_domain **domain,
                                                     geodisk_error *error);

/* The box [0, extents[0]) x [0, extents[1]) x ..., by straight-line distance. */
typedef struct geodisk_box_params {
    size_t struct_size;
    const double *extents; /* `dimension` of them. */
    uint32_t dimension;    /* 1 to 6. */
    int32_t is_periodic;   /* Not 0: opposite sides are glued together. */
    double min_distance;
    uint64_t seed;
    double pool_ratio;     /* As geodisk_surface_params has these. */
    uint32_t throws;
    uint32_t stop_count;
} geodisk_box_params;

/* A box. */
GEODISK_C_API geodisk_status geodisk_domain_box(const geodisk_box_params *params,
                                                geodisk_domain **domain, geodisk_error *error);

GEODISK_C_API void geodisk_domain_release(geodisk_domain *domain);

/* The distance that should give about `count` samples on a mesh, with radii or NULL. */
GEODISK_C_API geodisk_status geodisk_distance_for_count(const geodisk_mesh *mesh,
                                                        const geodisk_radii *radii, double count,
                                                        double *distance, geodisk_error *error);
/* The same in a box; its min_distance does not enter. */
GEODISK_C_API geodisk_status geodisk_box_distance_for_count(const geodisk_box_params *params,
                                                            double count, double *distance,
                                                            geodisk_error *error);

/* ---- Sampling ---------------------------------------------------------------------------------- */

/* Memory on a device, and the run in progress, if there is one. */
typedef struct geodisk_sampler geodisk_sampler;

/* The result of a run. */
typedef struct geodisk_samples geodisk_samples;

/* What a sampler may take, and how long it waits. */
typedef struct geodisk_sampler_options {
    size_t struct_size;
    uint64_t device_bytes;     /* Most to take on the device; 0 for no bound. */
    double submission_seconds; /* That one is to take; 0 for 0.02, or 0.1 on a CPU. */
    double stall_seconds;      /* After which a silent device is given up; 0 for 120, or 600. */
    int32_t count_calls;       /* Not 0: geodisk_report tells of CheckStatus calls. */
} geodisk_sampler_options;

/* Compiles what all domains share. A sampler keeps device memory for the next run. `options` may
 * be NULL. */
GEODISK_C_API geodisk_status geodisk_sampler_create(const geodisk_device *device,
                                                    const geodisk_sampler_options *options,
                                                    geodisk_sampler **sampler,
                                                    geodisk_error *error);

/* How far a run is. */
typedef struct geodisk_progress {
    size_t struct_size;
    uint32_t decided; /* Candidates, of `candidates`, about. */
    uint32_t candidates;
    uint32_t accepted;
    uint32_t disks;
    uint64_t windows;
} geodisk_progress;

/* Called between submissions, on the thread that samples; not 0 stops the run. It must not use the
 * sampler. */
typedef int32_t (*geodisk_progress_fn)(void *user, const geodisk_progress *progress);

/* Samples a domain and waits. `progress` may be NULL. */
GEODISK_C_API geodisk_status geodisk_sample(geodisk_sampler *sampler, const geodisk_domain *domain,
                                            geodisk_progress_fn progress, void *user,
                                            geodisk_samples **samples, geodisk_error *error);

/* The same without waiting: begins a run, which geodisk_poll goes on with. */
GEODISK_C_API geodisk_status geodisk_start(geodisk_sampler *sampler, const geodisk_domain *domain,
                                           geodisk_error *error);
/* Goes on with the run where the device is done with its part, and else waits for that, but no
 * longer than so many milliseconds. Writes the samples to `samples` once they are there, and NULL
 * before. A failure ends the run. */
GEODISK_C_API geodisk_status geodisk_poll(geodisk_sampler *sampler, uint32_t milliseconds,
                                          geodisk_samples **samples, geodisk_error *error);

/* How far the run that geodisk_poll goes on with is; all is 0 where there is none. */
GEODISK_C_API geodisk_status geodisk_sampler_progress(geodisk_sampler* sampler,
                                                      geodisk_progress* progress,
                                                      geodisk_error* error);

/* Stops the run in progress, which ends with GEODISK_CANCELLED. The one function of a sampler that
 * any thread may call while another has it; it does nothing where no run is in progress. */
GEODISK_C_API void geodisk_cancel(geodisk_sampler *sampler);

/* Frees what is kept on the device for the next run. */
GEODISK_C_API geodisk_status geodisk_sampler_trim(geodisk_sampler *sampler, geodisk_error *error);

/* Ends a run that was started, and waits for the device. */
GEODISK_C_API void geodisk_sampler_release(geodisk_sampler *sampler);

/* ---- Samples ----------------------------------------------------------------------------------- */

/* In the order of the darts: the first n of them are the set of the first n. */
GEODISK_C_API size_t geodisk_samples_count(const geodisk_samples *samples);

/* What a sample has. On surfaces: */
typedef int32_t geodisk_attribute;
enum {
    GEODISK_FACE = 0,        /* 1 integer: its triangle in the caller's mesh. */
    GEODISK_BARYCENTRIC = 1, /* 3 numbers: the weights of the triangle's corners; their sum is 1. */
    GEODISK_POSITION = 2,    /* Coordinates: those of the mesh, or in a box those of the box. */
    GEODISK_NORMAL = 3,      /* 3 numbers: of the triangle, of length 1; 0 where it has no area. */
    GEODISK_RADIUS = 4,      /* 1 number: half of the minimum distance where radii do not vary. */
    GEODISK_PART = 5         /* 1 integer: its surface, of several; GEODISK_FACE is of that one. */
};

/* Numbers of each sample that an attribute has; 0 where samples have none of it. */
GEODISK_C_API uint32_t geodisk_samples_width(const geodisk_samples *samples,
                                             geodisk_attribute attribute);

/* Writes an attribute of all samples to memory of the caller's, such as a mapped buffer: numbers of
 * `type` side by side, and `stride` bytes from sample to sample, 0 for none between. `capacity` is
 * in samples, and must be as many as there are. Integers go to GEODISK_UINT32, all else to
 * GEODISK_FLOAT64 or GEODISK_FLOAT32. Coordinates are computed in double precision. */
GEODISK_C_API geodisk_status geodisk_samples_copy(const geodisk_samples *samples,
                                                  geodisk_attribute attribute, geodisk_type type,
                                                  void *data, size_t stride, size_t capacity,
                                                  geodisk_error *error);

/* How a run went. */
typedef struct geodisk_report {
    size_t struct_size;
    uint64_t samples;
    uint32_t candidates; /* Decided. */
    uint32_t iterations; /* Batches of disks. */
    uint32_t dispatches;
    uint32_t disks;
    uint64_t windows;
    uint64_t device_bytes;
    double min_distance; /* Of the domain; of several surfaces the first one's. */
    double guard;        /* Conflicts were tested against min_distance * (1 + guard). */
    double rho;          /* Packing density; 0 of boxes and several surfaces. */
    double compile_seconds;
    double upload_seconds;
    double sample_seconds;
    double readback_seconds;
    uint64_t calls[10]; /* Candidates by CheckStatus calls: 1 to 9, and 10 or more. */
    uint32_t missing;   /* Samples fewer than stop_count asked for. */
    uint32_t reserved;
} geodisk_report;

/* How the run of these samples went. */
GEODISK_C_API geodisk_status geodisk_samples_report(const geodisk_samples *samples,
                                                    geodisk_report *report, geodisk_error *error);

GEODISK_C_API void geodisk_samples_release(geodisk_samples *samples);

/* ---- Recording --------------------------------------------------------------------------------- */

/* A run in command buffers and memory of the caller's, on a device that it lent: nothing is
 * allocated there, submitted or waited for, and the samples stay there. It goes like this:
 *
 *     geodisk_job_create    plans the run
 *     geodisk_job_need      how large each buffer must be; geodisk_job_lay_out puts all in one
 *     geodisk_job_bind      takes the caller's buffers
 *     geodisk_job_upload    what to copy into them before the first commands
 *     geodisk_job_record    records what comes next, at first GEODISK_BEGIN; submit it, with a copy
 *                           of the first bytes of GEODISK_CONTROL_BUFFER to where the host reads
 *     geodisk_job_advance   tells by such a copy what comes next, until GEODISK_COMPLETE
 *
 * A job is for one thread at a time, and another gets GEODISK_BUSY. Its command buffers must run
 * one after the other, and end before the job is released. Recording leaves the compute pipeline,
 * descriptor set 0 and the push constants changed, and has its own barriers among the job's
 * buffers. Those against other work are the caller's: the first commands write by transfers, and
 * read and write in compute shaders; the last ones write in both. */
typedef struct geodisk_job geodisk_job;

/* All may be 0. */
typedef struct geodisk_job_options {
    size_t struct_size;
    uint64_t pool_bytes; /* Most for disks in progress; 0 for 256 MiB. */
    uint32_t stages;     /* Of candidates drawn at once, which take memory; 0 chooses, 1 for darts. */
    uint32_t regrowths;  /* So many times the buffers suffice where disks outgrow the first plan. */
} geodisk_job_options;

/* `options` may be NULL. Compiles what runs of the domain need. The arithmetic of the device is
 * not checked, as geodisk_sampler_create does. */
GEODISK_C_API geodisk_status geodisk_job_create(const geodisk_device *device,
                                                const geodisk_domain *domain,
                                                const geodisk_job_options *options,
                                                geodisk_job **job, geodisk_error *error);

/* The buffers of a job, 0 to GEODISK_BUFFERS - 1. Those to know: */
enum {
    GEODISK_POOL_BUFFER = 8,
    GEODISK_CONTROL_BUFFER = 9,
    GEODISK_SAMPLES_BUFFER = 12, /* geodisk_sample_record of each sample. */
    GEODISK_ACCEPTED_BUFFER = 13,
    GEODISK_BUFFERS = 15
};

/* VkBufferUsageFlags for all of them: storage, both texel buffers, both transfers, indirect. */
#define GEODISK_BUFFER_USAGE 0x12fu

/* What a buffer of a job must have. */
typedef struct geodisk_buffer_need {
    size_t struct_size;
    uint64_t bytes;        /* At least; 0 where none is needed. */
    uint64_t upload_bytes; /* To be uploaded at its begin. */
    uint64_t read_bytes;   /* At its begin, for geodisk_job_advance. */
} geodisk_buffer_need;

/* What one buffer must have: at first, and where GEODISK_LARGER_POOL, GEODISK_LARGER_SAMPLES or
 * GEODISK_START_OVER comes next. */
GEODISK_C_API geodisk_status geodisk_job_need(geodisk_job *job, uint32_t buffer,
                                              geodisk_buffer_need *need, geodisk_error *error);

/* A range of a VkBuffer, aligned for storage and texel buffers. */
typedef struct geodisk_buffer_range {
    uint64_t buffer;
    uint64_t offset;
    uint64_t bytes;
} geodisk_buffer_range;

/* Lays out all buffers that the job needs in a single VkBuffer, from `offset` on, aligned as the
 * device asks. Writes GEODISK_BUFFERS ranges for geodisk_job_bind to `ranges`, and how many bytes
 * they span to `bytes`. Call it with a buffer of 0 to learn the size. */
GEODISK_C_API geodisk_status geodisk_job_lay_out(geodisk_job *job, uint64_t buffer, uint64_t offset,
                                                 geodisk_buffer_range *ranges, uint64_t *bytes,
                                                 geodisk_error *error);

/* Takes GEODISK_BUFFERS ranges that do not overlap; all 0 where none is needed. Where larger ones
 * are, the others stay the same; what GEODISK_SAMPLES_BUFFER and GEODISK_ACCEPTED_BUFFER held is
 * copied by the caller. No command buffer of the job may be pending. */
GEODISK_C_API geodisk_status geodisk_job_bind(geodisk_job *job, const geodisk_buffer_range *ranges,
                                              geodisk_error *error);

/* Writes the upload_bytes of a buffer to `data`: `bytes` is as many. Call it for each buffer that has
 * some, after each geodisk_job_bind of all buffers; GEODISK_BEGIN fails before that. */
GEODISK_C_API geodisk_status geodisk_job_upload(geodisk_job *job, uint32_t buffer, void *data,
                                                size_t bytes, geodisk_error *error);

/* What comes next for a job. */
typedef int32_t geodisk_next;
enum {
    GEODISK_BEGIN = 0,          /* To draw candidates: the first, more, or those left. */
    GEODISK_GO_ON = 1,          /* To decide them. */
    GEODISK_FINISH = 2,         /* To put the samples in order. */
    GEODISK_LARGER_POOL = 3,    /* geodisk_job_bind, then to record what goes back. */
    GEODISK_LARGER_SAMPLES = 4, /* The same. */
    GEODISK_START_OVER = 5,     /* geodisk_job_bind and all uploads anew, then to begin. */
    GEODISK_COMPLETE = 6        /* The samples are there. */
};

/* Records it to a VkCommandBuffer, outside of a render pass. `amount`: of GEODISK_GO_ON so many
 * rounds, 0 for one; of GEODISK_BEGIN and GEODISK_FINISH at most so many dispatches, 0 for all.
 * Writes to `is_last`, unless it is NULL, whether none of them is left; whatever is recorded next
 * begins with those.
 *
 * Rounds that come after the last are empty. GEODISK_FINISH may be recorded at any time: what is
 * decided so far are the first samples of the set, and stay where they are. */
GEODISK_C_API geodisk_status geodisk_job_record(geodisk_job *job, void *command_buffer,
                                                geodisk_next what, uint32_t amount,
                                                int32_t *is_last, geodisk_error *error);

/* What geodisk_job_advance tells. */
typedef struct geodisk_advice {
    size_t struct_size;
    geodisk_next next;
    uint32_t ready; /* Samples in order and final, as far as the host knows. */
} geodisk_advice;

/* `control`: the first `bytes` of GEODISK_CONTROL_BUFFER, which are its read_bytes. Copies of any
 * time will do, so that frames may be in flight: an old one says to go on. */
GEODISK_C_API geodisk_status geodisk_job_advance(geodisk_job *job, const void *control,
                                                 size_t bytes, geodisk_advice *advice,
                                                 geodisk_error *error);

/* Begins anew with another seed, by GEODISK_BEGIN; what was uploaded stays. */
GEODISK_C_API geodisk_status geodisk_job_set_seed(geodisk_job *job, uint64_t seed,
                                                  geodisk_error *error);

/* Makes it a job of another domain, with the options that it was created with: GEODISK_START_OVER
 * comes next, for which the same buffers do where they are large enough. Nothing is allocated then,
 * unless the domain is of another kind. After an error it is as it was. */
GEODISK_C_API geodisk_status geodisk_job_renew(geodisk_job *job, const geodisk_domain *domain,
                                               geodisk_error *error);

GEODISK_C_API void geodisk_job_release(geodisk_job *job);

/* The weight of the first corner is 1 less both; of boxes all but the order is internal. */
typedef struct geodisk_sample_record {
    uint32_t order, face;
    float weight1, weight2;
} geodisk_sample_record;

/* Where samples of a job are drawn: on the device, by the caller's own vertices. */
typedef struct geodisk_placement geodisk_placement;

/* A sample there. The normal has length 1, or 0 of a face without one; the face is of its part. */
typedef struct geodisk_placed_record {
    float position[3], radius;
    float normal[3];
    uint32_t face;
    float weight1, weight2;
    uint32_t part, order;
} geodisk_placed_record;

/* Ranges are storage buffers; offsets and strides are multiples of 4 bytes. */
typedef struct geodisk_placement_params {
    size_t struct_size;
    geodisk_buffer_range vertices; /* With three floats of a position each. */
    uint32_t vertex_stride;        /* 0 for 12. */
    uint32_t position_offset;      /* In a vertex. */
    int32_t has_normals;           /* Not 0: three floats of them, else those of faces. */
    uint32_t normal_offset;
    /* Three for each face; those of several surfaces follow each other. */
    geodisk_buffer_range indices;
    geodisk_type index_type; /* GEODISK_UINT32 or GEODISK_UINT16; 0 for GEODISK_UINT32. */
    uint32_t vertices_each;  /* In `arguments`; 0 for 1. */
    /* geodisk_placed_record of each sample, as many as GEODISK_SAMPLES_BUFFER has records. */
    geodisk_buffer_range placed;
    /* 16 bytes: a VkDrawIndirectCommand with an instance for each sample. */
    geodisk_buffer_range arguments;
} geodisk_placement_params;

/* Of a job with buffers, and a surface with geodesic distance. */
GEODISK_C_API geodisk_status geodisk_placement_create(geodisk_job *job,
                                                      const geodisk_placement_params *params,
                                                      geodisk_placement **placement,
                                                      geodisk_error *error);
/* Behind GEODISK_FINISH, to the same command buffer or a later one. Where the job has started over
 * or has larger buffers for its samples, another placement is needed. */
GEODISK_C_API geodisk_status geodisk_placement_record(const geodisk_placement *placement,
                                                      geodisk_job *job, void *command_buffer,
                                                      geodisk_error *error);
GEODISK_C_API void geodisk_placement_release(geodisk_placement *placement);

/* ---- Samples in the frames of an engine -------------------------------------------------------- */

/* A job with its memory and placement in one object: it allocates one buffer for all that stays on
 * the device, records a bounded amount of work into the caller's command buffers, and keeps the
 * samples where the caller draws them. geodisk/frame_sampler.hpp tells more. */
typedef struct geodisk_frame_sampler geodisk_frame_sampler;

/* All may be 0. */
typedef struct geodisk_frame_options {
    size_t struct_size;
    uint64_t pool_bytes;    /* Memory for disks in progress; 0 for 16 MiB. */
    uint32_t frames;        /* Command buffers in flight, 1 to 16; 0 for 2. */
    uint32_t dispatches;    /* Most for drawing candidates in one record; 0 for 16. */
    uint32_t rounds;        /* For deciding them in one record; 0 for 2. */
    uint32_t vertices_each; /* Vertices of each instance of the indirect draw; 0 for 1. */
    /* VkPipelineStageFlags and VkAccessFlags of the caller's commands that read the samples; both 0
     * for indirect draws, compute shaders and transfers. */
    uint32_t reader_stages;
    uint32_t reader_access;
} geodisk_frame_options;

/* `options` may be NULL. The meshes of the domain must have 2 or 3 coordinates per vertex. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_create(const geodisk_device *device,
                                                          const geodisk_domain *domain,
                                                          const geodisk_frame_options *options,
                                                          geodisk_frame_sampler **frames,
                                                          geodisk_error *error);

/* Records the next part of the work to a VkCommandBuffer, outside of a render pass, and writes to
 * `is_complete`, which may be NULL, whether all samples are there. Call it only when the command
 * buffer recorded `frames` calls ago has completed, and submit in the order of the calls. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_record(geodisk_frame_sampler *frames,
                                                          void *command_buffer,
                                                          int32_t *is_complete,
                                                          geodisk_error *error);

/* Submits on the sampler's queue and waits until all samples are there. No command buffer of
 * geodisk_frame_sampler_record may be pending. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_wait(geodisk_frame_sampler *frames,
                                                        geodisk_sampler *sampler,
                                                        geodisk_error *error);

/* Where the samples lie, until the next call that records or waits. */
typedef struct geodisk_frame_samples {
    size_t struct_size;
    uint64_t buffer;           /* VkBuffer, which may also be bound as vertex buffer. */
    uint64_t placed_offset;    /* Of a geodisk_placed_record for each sample, in dart order. */
    uint64_t arguments_offset; /* Of a VkDrawIndirectCommand with an instance for each sample. */
    uint64_t device_bytes;     /* Allocated on the device. */
    uint32_t capacity;         /* Records that there is room for. */
    uint32_t ready;            /* Samples in order and final, as far as the host knows. */
    int32_t is_complete;       /* Not 0: those are all. */
} geodisk_frame_samples;

GEODISK_C_API geodisk_status geodisk_frame_sampler_describe(const geodisk_frame_sampler *frames,
                                                            geodisk_frame_samples *samples,
                                                            geodisk_error *error);

/* Begins again with another seed. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_set_seed(geodisk_frame_sampler *frames,
                                                            uint64_t seed, geodisk_error *error);

/* No command buffer that it recorded may be pending. */
GEODISK_C_API void geodisk_frame_sampler_release(geodisk_frame_sampler *frames);

/* ---- Finding a distance by a count ------------------------------------------------------------- */

/* Where about so many samples are wanted: tries distances, beginning with that of
 * geodisk_distance_for_count, until the samples are within 5 % of them or one, or some tries have
 * not come so close. The nearest set is the answer. Sample without stop_count meanwhile: the search
 * cannot see what that cuts off. */
typedef struct geodisk_count_search geodisk_count_search;

/* A search for about `wanted` samples, at least 1. */
GEODISK_C_API geodisk_status geodisk_count_search_create(double wanted,
                                                         geodisk_count_search **search,
                                                         geodisk_error *error);
/* Notes how many samples a distance gave. Writes the distance to try next, or 0 where none is to
 * be, and whether this try is the nearest so far. */
GEODISK_C_API geodisk_status geodisk_count_search_note(geodisk_count_search *search,
                                                       double distance, uint64_t count,
                                                       double *next, int32_t *is_nearest,
                                                       geodisk_error *error);
GEODISK_C_API void geodisk_count_search_release(geodisk_count_search *search);

#ifdef __cplusplus
}
#endif

#endif
