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

/* A device and queue of the caller's, by their Vulkan handles. They must outlive all objects made
 * from them, samples aside, and geodisk destroys none of them. */
typedef struct geodisk_vulkan_device {
    size_t struct_size;
    void *instance;                         /* VkInstance. */
    void *physical_device;                  /* VkPhysicalDevice. */
    void *device;                           /* VkDevice. */
    void (*get_instance_proc_addr)(void);   /* PFN_vkGetInstanceProcAddr. */
    uint32_t api_version;                   /* The lower of the instance's and the device's; 0 for 1.1. */
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
    uint64_t coinciding_border_edges; /* Open seams of doubled vertices, which weld closes. */
    uint64_t nonmanifold_edges;
    uint64_t repeated_index_faces;    /* They take no part. */
    uint64_t zero_area_faces;         /* They hold no sample. */
    uint64_t merged_vertices;         /* By weld. */
    double area;
    double diagonal;                  /* Of the bounding box. */
    double longest_edge;
} geodisk_mesh_info;

/* What became known of a mesh as it was prepared. */
GEODISK_C_API geodisk_status geodisk_mesh_describe(const geodisk_mesh *mesh,
                                                   geodisk_mesh_info *info, geodisk_error *error);

GEODISK_C_API void geodisk_mesh_release(geodisk_mesh *mesh);

/* Radii that vary: at each vertex a factor of 0.001 to 1, by which the radius is smaller than half
 * of min_distance; linear in each face. Two samples are as far apart as both radii together. */
typedef struct geodisk_radii geodisk_radii;

/* `factors`: one for each vertex of the mesh, of GEODISK_FLOAT64 or GEODISK_FLOAT32. */
GEODISK_C_API geodisk_status geodisk_radii_create(const geodisk_mesh *mesh, const void *factors,
                                                  geodisk_type type, size_t count,
                                                  geodisk_radii **radii, geodisk_error *error);
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
} geodisk_report;

/* How the run of these samples went. */
GEODISK_C_API geodisk_status geodisk_samples_report(const geodisk_samples *samples,
                                                    geodisk_report *report, geodisk_error *error);

GEODISK_C_API void geodisk_samples_release(geodisk_samples *samples);

/* ---- Finding a distance by a count ------------------------------------------------------------- */

/* Where about so many samples are wanted: tries distances, beginning with that of
 * geodisk_distance_for_count, until the samples are within 5 % of them or one, or some tries have
 * not come so close. The nearest set is the answer. */
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
