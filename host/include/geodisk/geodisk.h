/* geodisk in C: random points on triangle meshes, no two closer than a minimum distance along the
 * surface.
 *
 *     geodisk_error error = GEODISK_INIT(geodisk_error);
 *     geodisk_device *device = NULL;
 *     geodisk_sampler *sampler = NULL;
 *     geodisk_mesh *mesh = NULL;
 *     geodisk_domain *domain = NULL;
 *     geodisk_samples *samples = NULL;
 *
 *     geodisk_mesh_params shape = GEODISK_INIT(geodisk_mesh_params);   then set its arrays
 *     geodisk_surface_params job = GEODISK_INIT(geodisk_surface_params);
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
 * Functions return GEODISK_OK (0) or a negative status. They never exit, print or throw. `error`
 * may be NULL; otherwise it is written by every call, also on success. Objects are written only on
 * success. The caller owns them and releases each once; releasing NULL does nothing. There is no
 * global state.
 *
 * Objects keep what they need from the objects they were made from, so these may be released first.
 * Any number of threads may use one device, mesh, radii, domain or samples: these never change.
 * Use a sampler in one thread at a time; a call from another thread returns GEODISK_BUSY. Do not
 * release an object while a call uses it.
 *
 * Structs begin with `struct_size`, the sizeof of the struct: GEODISK_INIT(type) sets it. All other
 * fields may be 0 for the default, as it sets them.
 *
 * The comment of each function ends with "Stable." or "Experimental."; host/docs/c.md says what that
 * means. "Versions" in README.md says which changes a version may bring.
 *
 * Lengths are in mesh units, or in units of the box. Samples are the same on every device.
 * host/docs/c.md has examples. The C++ headers beside this one say more about each function.
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

/* Returns a struct with its size, and 0 for all other fields. */
#ifdef __cplusplus
extern "C++" template <class Struct>
inline Struct geodisk_init() {
    Struct value = Struct();
    value.struct_size = sizeof value;
    return value;
}
/* Initialized struct of a type; in C, the initializer of a declaration. */
#define GEODISK_INIT(type) geodisk_init<type>()
#else
#define GEODISK_INIT(type) {.struct_size = sizeof(type)}
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Outcomes ---------------------------------------------------------------------------------- */

/* Outcome of a call. Zero is success, negative is failure. */
typedef int32_t geodisk_status;
enum {
    GEODISK_OK = 0,
    GEODISK_INVALID_ARGUMENT = -1,    /* A parameter is out of its range, or NULL. */
    GEODISK_MESH_REJECTED = -2,       /* The mesh cannot be sampled; `element` names the place. */
    GEODISK_DEVICE_LACKS = -3,        /* The device lacks a required limit or feature. */
    GEODISK_NO_DEVICE = -4,           /* No Vulkan loader, driver or device was found. */
    GEODISK_WORKSPACE_TOO_SMALL = -5, /* The limit for device memory is too low. */
    GEODISK_OUT_OF_HOST_MEMORY = -6,
    GEODISK_OUT_OF_DEVICE_MEMORY = -7,
    GEODISK_DEVICE_LOST = -8,   /* The sampler refuses all further work. */
    GEODISK_CANCELLED = -9,     /* geodisk_cancel or the progress callback stopped the run. */
    GEODISK_INTERNAL = -10,     /* A bug in geodisk or in the driver. */
    GEODISK_JOB_TOO_LARGE = -11,/* A buffer exceeds what the device can bind. */
    GEODISK_BUSY = -12          /* Another thread or a run in progress uses the object. */
};

/* Marks an error that does not concern one face or vertex. */
#define GEODISK_NO_ELEMENT UINT64_MAX

/* Outcome of a call in detail. */
typedef struct geodisk_error {
    size_t struct_size;
    geodisk_status status;
    int32_t vk_result; /* The VkResult behind a failure, if any. */
    uint64_t element;  /* Index of the offending face or vertex, or GEODISK_NO_ELEMENT. */
    char message[1024];/* One line of UTF-8; empty for success. */
} geodisk_error;

/* Returns the name of a status, such as "invalid_argument"; "unknown" for any other number.
 * Stable. */
GEODISK_C_API const char *geodisk_status_name(geodisk_status status);

/* Returns the version of the library, "major.minor.patch". Stable. */
GEODISK_C_API const char *geodisk_version(void);
/* Returns the number of the rule that turns a seed into a set. It changes only when some set does.
 * Stable. */
GEODISK_C_API uint32_t geodisk_sampling_version(void);

/* ---- Devices ----------------------------------------------------------------------------------- */

/* A device to sample on, with its compiled pipelines. */
typedef struct geodisk_device geodisk_device;

/* Stands for a queue family that a device lacks. */
#define GEODISK_NO_QUEUE_FAMILY UINT32_MAX

/* Properties of a Vulkan device. */
typedef struct geodisk_device_info {
    size_t struct_size;
    int32_t is_usable; /* Not 0: geodisk can run on it. */
    uint32_t type; /* VkPhysicalDeviceType: 1 integrated, 2 discrete, 3 virtual, 4 CPU. */
    uint32_t vendor_id;
    uint32_t device_id;
    uint32_t api_version;
    uint32_t driver_version;
    uint32_t compute_queue_family;  /* Recommended family, or GEODISK_NO_QUEUE_FAMILY. */
    uint32_t graphics_queue_family; /* Family with graphics too, or GEODISK_NO_QUEUE_FAMILY. */
    uint64_t memory_bytes;          /* Size of its largest device-local heap. */
    uint8_t uuid[16];
    char name[256];
    char driver[512];
    char reasons[1024]; /* Every unmet requirement, one line each; empty if usable. */
} geodisk_device_info;

/* Lists the devices of this machine. Writes the first `capacity` of them to `infos`, and the number
 * of all devices to `count`. All elements have the struct_size of the first one. Stable. */
GEODISK_C_API geodisk_status geodisk_list_devices(geodisk_device_info *infos, size_t capacity,
                                                  size_t *count, geodisk_error *error);

/* Which device to open, and how. */
typedef struct geodisk_device_options {
    size_t struct_size;
    /* Part of its name, its index, or its UUID; NULL or "" for the best one. */
    const char *device;
    /* Not 0: load the validation layer. For development. */
    int32_t validation;
    /* Not 0: keep compiled pipelines in a file for later processes, and take them from there. The
     * file is in the folder geodisk of the user's cache folder; a damaged one, or one that cannot be
     * written, is ignored. GEODISK_CACHE=off in the environment turns it off. */
    int32_t keep_pipelines;
} geodisk_device_options;

/* Opens a device that only geodisk uses. `options` may be NULL. Stable. */
GEODISK_C_API geodisk_status geodisk_device_open(const geodisk_device_options *options,
                                                 geodisk_device **device, geodisk_error *error);

/* Request for the memory of a buffer. Flags are VkMemoryPropertyFlags. */
typedef struct geodisk_memory_request {
    size_t struct_size;
    uint64_t buffer; /* VkBuffer that geodisk will bind to the memory. */
    uint64_t bytes;
    uint64_t alignment;
    uint32_t memory_types; /* Bit set of allowed memory types. */
    uint32_t required;     /* Host visible and coherent if the host writes or reads the buffer. */
    uint32_t preferred;    /* Properties to prefer among suitable memory types. */
} geodisk_memory_request;

/* Memory that the caller grants for a buffer. */
typedef struct geodisk_memory_grant {
    size_t struct_size;
    uint64_t memory; /* VkDeviceMemory. */
    uint64_t offset; /* First byte, aligned as requested. */
    void *mapped;    /* Host address of `offset`, valid until freed. Not NULL if host visible memory
                      * was required. */
    void *allocation;/* Value of the caller's choice, for `free`. */
} geodisk_memory_grant;

/* A device and queue of the caller's, as Vulkan handles. They must outlive all objects made from
 * them, except samples. geodisk destroys none of them. */
typedef struct geodisk_vulkan_device {
    size_t struct_size;
    void *instance;                         /* VkInstance. */
    void *physical_device;                  /* VkPhysicalDevice. */
    void *device;                           /* VkDevice. */
    void (*get_instance_proc_addr)(void);   /* PFN_vkGetInstanceProcAddr. */
    uint32_t api_version;                   /* Lower of instance and device version; 0 for 1.1. */
    uint32_t queue_family;                  /* Family of `queue`; must support compute. */
    void *queue;                            /* VkQueue. */
    uint64_t pipeline_cache;                /* VkPipelineCache, or 0. */
    int32_t memory_budget;                  /* Not 0: VK_EXT_memory_budget is enabled. */
    int32_t debug_utils;                    /* Not 0: VK_EXT_debug_utils is enabled. */
    /* Called around each submission. Set them if other threads submit to the queue, else NULL. */
    void *lock_user;
    void (*lock)(void *lock_user);
    void (*unlock)(void *lock_user);
    const void *host_allocator; /* VkAllocationCallbacks, or NULL. */
    /* Callbacks to an allocator for the buffers of runs, such as VMA. NULL: geodisk allocates
     * device memory for each buffer. `allocate` fills `grant` and returns VK_SUCCESS, or returns an
     * error of vkAllocateMemory. */
    void *memory_user;
    int32_t (*allocate)(void *memory_user, const geodisk_memory_request *request,
                        geodisk_memory_grant *grant);
    void (*free)(void *memory_user, const geodisk_memory_grant *grant);
} geodisk_vulkan_device;

/* Makes a device from a VkDevice and queue of the caller's. Stable. */
GEODISK_C_API geodisk_status geodisk_device_borrow(const geodisk_vulkan_device *lent,
                                                   geodisk_device **device, geodisk_error *error);

/* Reports on a physical device. Call it before vkCreateDevice, and create the device with a queue
 * of compute_queue_family. A device that geodisk cannot use is not an error. Stable. */
GEODISK_C_API geodisk_status geodisk_query_device(void (*get_instance_proc_addr)(void),
                                                  void *instance, void *physical_device,
                                                  geodisk_device_info *info, geodisk_error *error);

/* Reports on a device that was opened or borrowed. Stable. */
GEODISK_C_API geodisk_status geodisk_device_describe(const geodisk_device *device,
                                                     geodisk_device_info *info,
                                                     geodisk_error *error);

/* Releases the device. Stable. */
GEODISK_C_API void geodisk_device_release(geodisk_device *device);

/* ---- Meshes ------------------------------------------------------------------------------------ */

/* Type of numbers in the caller's memory. */
typedef int32_t geodisk_type;
enum { GEODISK_FLOAT64 = 0, GEODISK_FLOAT32 = 1, GEODISK_UINT32 = 2, GEODISK_UINT16 = 3 };

/* A mesh prepared for any number of runs. */
typedef struct geodisk_mesh geodisk_mesh;

/* A triangle mesh in the caller's memory. Any number of faces may share an edge. Faces may have
 * either orientation and leave borders open. */
typedef struct geodisk_mesh_params {
    size_t struct_size;
    const void *positions;      /* `dimension` adjacent coordinates per vertex. */
    geodisk_type position_type; /* GEODISK_FLOAT64 or GEODISK_FLOAT32. */
    uint32_t dimension;         /* Coordinates per vertex, 2 to 8; 0 for 3. */
    size_t vertex_count;
    size_t position_stride;     /* Bytes from one vertex to the next; 0 if packed. */
    const void *indices;        /* Three vertex indices per face. */
    geodisk_type index_type;    /* GEODISK_UINT32 or GEODISK_UINT16; 0 for GEODISK_UINT32. */
    size_t face_count;
    size_t index_stride;        /* Bytes from one index to the next; 0 if packed. */
    /* Three edge lengths per face, instead of positions: from the first corner to the second, to
     * the third, and back. */
    const double *edge_lengths;
    /* Not 0: join vertices at the same place, and those at most weld_distance apart. */
    int32_t weld;
    double weld_distance;
    uint32_t max_threads;      /* Maximum of threads that prepare the mesh; 0 for 16. */
    /* 0: join border edges that lie exactly on other border edges, for example along seams of
     * texture coordinates. Not 0: connect only faces that share vertices. */
    int32_t keep_seams;
} geodisk_mesh_params;

/* Prepares a mesh. Copies what it needs; the caller's memory is not used afterwards. Stable. */
GEODISK_C_API geodisk_status geodisk_mesh_create(const geodisk_mesh_params *params,
                                                 geodisk_mesh **mesh, geodisk_error *error);

/* Saves a mesh without its coordinates, for geodisk_mesh_load. Writes the number of bytes to
 * `size`, and the bytes to `bytes` if `capacity` is large enough. `bytes` may be NULL. Stable. */
GEODISK_C_API geodisk_status geodisk_mesh_save(const geodisk_mesh *mesh, void *bytes,
                                               size_t capacity, size_t *size, geodisk_error *error);
/* Loads a saved mesh. The bytes may come from any source: they are checked completely. Stable. */
GEODISK_C_API geodisk_status geodisk_mesh_load(const void *bytes, size_t size, geodisk_mesh **mesh,
                                               geodisk_error *error);

/* Statistics of a mesh. */
typedef struct geodisk_mesh_info {
    size_t struct_size;
    uint32_t dimension; /* Coordinates per vertex; 0 for a mesh without coordinates. */
    uint64_t vertices;  /* Vertices used by a face. */
    uint64_t faces;
    uint64_t components;
    uint64_t boundary_edges;
    uint64_t coinciding_border_edges; /* Border edges of seams that keep_seams leaves open. */
    uint64_t nonmanifold_edges;
    uint64_t repeated_index_faces;    /* Faces that name a vertex twice. Ignored. */
    uint64_t zero_area_faces;         /* Faces without area. They hold no sample. */
    uint64_t merged_vertices;         /* Vertices joined to others, by weld or along seams. */
    double area;
    double diagonal;                  /* Diagonal of the bounding box. */
    double longest_edge;
    uint64_t joined_edges;            /* Border edges joined to others along seams. */
} geodisk_mesh_info;

/* Writes the statistics of a mesh to `info`. Stable. */
GEODISK_C_API geodisk_status geodisk_mesh_describe(const geodisk_mesh *mesh,
                                                   geodisk_mesh_info *info, geodisk_error *error);

/* Releases the mesh. Stable. */
GEODISK_C_API void geodisk_mesh_release(geodisk_mesh *mesh);

/* Faces and edges of a mesh that no path crosses. */
typedef struct geodisk_walls {
    size_t struct_size;
    const void *indices;     /* Three vertex indices per face. */
    geodisk_type index_type; /* GEODISK_UINT32 or GEODISK_UINT16; 0 for GEODISK_UINT32. */
    size_t face_count;
    size_t index_stride;     /* Bytes from one index to the next; 0 if packed. */
    size_t vertex_count;
    const uint8_t *faces;    /* A byte per face, other than 0 for a wall; NULL for none. */
    const uint32_t *edges;   /* Two vertices per edge that is a wall; NULL for none. */
    size_t edge_count;
} geodisk_walls;

/* Cuts a mesh along walls, for geodisk_mesh_create with keep_seams. Writes three indices per face to
 * `indices`: a face that is a wall names one vertex three times. A vertex that walls of edges pass
 * is copied, so that each side has its own. Writes the number of copies to `count`, and to `copied`
 * the vertex that each is a copy of, if `capacity` is large enough; 3 * face_count always is. Copies
 * are numbered from vertex_count on: append their positions. Seams that are to be joined must be
 * joined before. Experimental. */
GEODISK_C_API geodisk_status geodisk_cut(const geodisk_walls *walls, uint32_t *indices,
                                         uint32_t *copied, size_t capacity, size_t *count,
                                         geodisk_error *error);

/* Radii that vary over a mesh. The radius at a point is half of min_distance times a factor, 0.001
 * to 1, given per vertex and linear in each face. Two samples are at least the sum of their radii
 * apart. */
typedef struct geodisk_radii geodisk_radii;

/* Makes radii from one factor per vertex, of GEODISK_FLOAT64 or GEODISK_FLOAT32. Joined vertices
 * use the mean of their factors; in a mesh from geodisk_mesh_load, the factor of the lowest.
 * Stable. */
GEODISK_C_API geodisk_status geodisk_radii_create(const geodisk_mesh *mesh, const void *factors,
                                                  geodisk_type type, size_t count,
                                                  geodisk_radii **radii, geodisk_error *error);

/* Makes radii from one density per vertex, 0 or positive, in any unit. Joined vertices are treated
 * as above. Samples per area are proportional to the density; none where it is 0. Stable. */
GEODISK_C_API geodisk_status geodisk_density_create(const geodisk_mesh *mesh, const void *density,
                                                    geodisk_type type, size_t count,
                                                    geodisk_radii **radii, geodisk_error *error);

/* Returns the smallest factor; 1 for NULL. No two samples are closer than min_distance times this
 * factor. Stable. */
GEODISK_C_API double geodisk_radii_min_factor(const geodisk_radii *radii);

/* Releases the radii. Stable. */
GEODISK_C_API void geodisk_radii_release(geodisk_radii *radii);

/* ---- Domains: what is sampled ------------------------------------------------------------------ */

/* A surface or box to sample, and how to sample it. */
typedef struct geodisk_domain geodisk_domain;

/* Distance to use. All but the first are for comparison. */
typedef int32_t geodisk_metric;
enum { GEODISK_GEODESIC = 0, GEODISK_EUCLIDEAN = 1, GEODISK_APPROXIMATE = 2 };

/* A point of a surface. */
typedef struct geodisk_surface_point {
    uint32_t face;    /* Index of its triangle. */
    float weights[3]; /* Weights of the triangle's corners; they sum to 1. */
} geodisk_surface_point;

/* How to sample a surface. */
typedef struct geodisk_surface_params {
    size_t struct_size;
    double min_distance; /* D > 0: no two samples are closer along the surface. */
    uint64_t seed;
    double pool_ratio;   /* Candidates per expected sample, 1 to 10,000; 0 for 20. */
    uint32_t darts;     /* Not 0: throw this many darts instead of a pool by pool_ratio. */
    uint32_t stop_count; /* Not 0: stop after this many samples. */
    const geodisk_radii *radii; /* Radii of the same mesh; NULL for min_distance / 2 everywhere. */
    /* One key per face, all different, by which its candidates are drawn: a triangle with the same
     * key has the same candidates in every mesh. NULL for the indices of faces. */
    const uint32_t *face_keys;
    geodisk_metric metric; /* All but GEODISK_GEODESIC need three coordinates and no radii. */
    /* One byte per face: a face with 0 gets no samples, but paths cross it. NULL if all faces take
     * samples. */
    const uint8_t *face_mask;
    /* Samples that are given, which are copied; NULL for none. They are the first samples of the
     * run, in this order, and new ones keep the minimum distance from them. Distances among them
     * are not checked. They count towards stop_count. */
    const geodisk_surface_point *existing;
    size_t existing_count;
    /* Points to avoid, which are copied, and a positive radius for each; NULL for none. No sample
     * but existing ones is within the geodesic radius of its point. For GEODISK_GEODESIC only. */
    const geodisk_surface_point *avoid;
    const double *avoid_radii;
    size_t avoid_count;
    /* Distances of 2 to 8 classes of samples, as parts of min_distance: a symmetric table of
     * class_count * class_count factors from 0.01 to 1, row by row, which is copied; NULL if
     * samples have no classes. Samples of the classes a and b are at least
     * class_factors[class_count * a + b] * min_distance apart; 0 for two classes that keep no
     * distance from each other. For GEODISK_GEODESIC only, without
     * radii and for one surface. */
    const float *class_factors;
    size_t class_count;
    const uint8_t *existing_classes; /* Class of each existing sample; NULL if all have class 0. */
    /* Not 0: go on after the pool until no further sample fits anywhere, in several rounds. Only
     * geodisk_sample and geodisk_run do. For GEODISK_GEODESIC, without darts, stop_count, and radii
     * from a density. */
    int32_t is_maximal;
    /* Class that each point to avoid keeps out, 255 for all; NULL if all keep out all. Copied. */
    const uint8_t *avoid_classes;
    /* Share of its samples that each class has at the corners of faces, from 0 for none to 1 for all
     * that fit: class_count * face_count * 3 of them, class by class, which are copied; NULL if all
     * classes may lie everywhere. Linear in a face, in steps of 1/512. */
    const float *class_shares;
} geodisk_surface_params;

/* Makes the domain of one surface. Stable. */
GEODISK_C_API geodisk_status geodisk_domain_surface(const geodisk_mesh *mesh,
                                                    const geodisk_surface_params *params,
                                                    geodisk_domain **domain, geodisk_error *error);

/* Makes the domain of samples on features, to run before the surface: on corners first, then on
 * curves, which are edges whose faces meet at more than `degrees` (1 to 180), borders, and edges of
 * more than two faces. Distances are those of the surface, also from params->existing. Pass the
 * samples of the run as `existing` to geodisk_domain_surface, with the other parameters unchanged. A
 * sample on a corner has two weights of 0, on a curve one. `params` may have no darts and classes,
 * and no radii from a density; its metric is GEODISK_GEODESIC. The mesh needs coordinates. If
 * `corners` is not NULL, writes the number of corners of the mesh; those closer to others than the
 * distance have no sample. Writes NULL to `domain` if there are no features. Experimental. */
GEODISK_C_API geodisk_status geodisk_domain_features(const geodisk_mesh *mesh,
                                                     const geodisk_surface_params *params,
                                                     double degrees, size_t *corners,
                                                     geodisk_domain **domain,
                                                     geodisk_error *error);

/* Everything global about a job on a surface, as bytes that are the same on every machine. They tell
 * their version and that of the sampling; later versions keep the size. */
typedef struct geodisk_job_frame {
    unsigned char bytes[128];
} geodisk_job_frame;

/* Derives the frame of a job, to sample parts of its mesh as the whole is sampled. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_frame_of(const geodisk_mesh *mesh,
                                                  const geodisk_surface_params *params,
                                                  geodisk_job_frame *frame, geodisk_error *error);

/* Makes the domain of one surface by geodesic distance, in the frame of a mesh that it is a part of.
 * Give it the parameters of the whole, and the face keys that its faces have in the whole.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_domain_surface_in_frame(const geodisk_mesh *mesh,
                                                             const geodisk_surface_params *params,
                                                             const geodisk_job_frame *frame,
                                                             geodisk_domain **domain,
                                                             geodisk_error *error);

/* One of several surfaces that are sampled as one job: an instance of a mesh. */
typedef struct geodisk_surface_part {
    size_t struct_size;
    const geodisk_mesh *mesh;
    const geodisk_surface_params *params; /* Of this surface; without darts and stop_count. */
    double scale;                         /* Length of a unit of the mesh; 0 for 1. */
} geodisk_surface_part;

/* Makes the domain of several surfaces. Each surface gets the samples that it gets alone. All
 * `count` elements of `parts` have the struct_size of the first one. Experimental. */
GEODISK_C_API geodisk_status geodisk_domain_surfaces(const geodisk_surface_part *parts,
                                                     size_t count, geodisk_domain **domain,
                                                     geodisk_error *error);

/* The box [0, extents[0]) x [0, extents[1]) x ..., sampled by straight-line distance. */
typedef struct geodisk_box_params {
    size_t struct_size;
    const double *extents; /* `dimension` sides, each positive. */
    uint32_t dimension;    /* 1 to 6. */
    int32_t is_periodic;   /* Not 0: opposite sides are glued together. */
    double min_distance;   /* This and the following as in geodisk_surface_params. */
    uint64_t seed;
    double pool_ratio;
    uint32_t darts;
    uint32_t stop_count;
} geodisk_box_params;

/* Makes the domain of a box. Stable. */
GEODISK_C_API geodisk_status geodisk_domain_box(const geodisk_box_params *params,
                                                geodisk_domain **domain, geodisk_error *error);

/* Releases the domain. Stable. */
GEODISK_C_API void geodisk_domain_release(geodisk_domain *domain);

/* Writes the distance that should give about `count` samples on a mesh. `radii` and `face_mask` are
 * as in geodisk_surface_params. Stable. */
GEODISK_C_API geodisk_status geodisk_distance_for_count(const geodisk_mesh *mesh,
                                                        const geodisk_radii *radii,
                                                        const uint8_t *face_mask, double count,
                                                        double *distance, geodisk_error *error);
/* Writes the distance that should give about `count` samples in a box; ignores min_distance.
 * Stable. */
GEODISK_C_API geodisk_status geodisk_box_distance_for_count(const geodisk_box_params *params,
                                                            double count, double *distance,
                                                            geodisk_error *error);

/* Writes the number of levels, in progressive order, of a run with these parameters, whose distance
 * is that of the last level. Each level has the distance of the next one times `factor`, 1.1 to 8;
 * 0 for 2. The first level expects 16 samples or up to factor * factor times as many.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_level_count(const geodisk_mesh *mesh,
                                                 const geodisk_surface_params *params,
                                                 double factor, uint32_t *levels,
                                                 geodisk_error *error);
/* Writes the distance and the seed of a level; level 0 is the first of `levels`, at most 32. Sample
 * level by level with these and otherwise the same parameters: the first level with their `existing`,
 * each later one with the samples of all levels before it as `existing`. The samples up to the end of
 * a level are a Poisson-disk set of its distance. Not for darts. Experimental. */
GEODISK_C_API geodisk_status geodisk_level_params(const geodisk_surface_params *params,
                                                  double factor, uint32_t levels, uint32_t level,
                                                  double *min_distance, uint64_t *seed,
                                                  geodisk_error *error);

/* ---- Sampling ---------------------------------------------------------------------------------- */

/* Runs one domain at a time on a device, and keeps device memory for the next run. */
typedef struct geodisk_sampler geodisk_sampler;

/* The result of a run. */
typedef struct geodisk_samples geodisk_samples;

/* Limits of a sampler: memory and time. */
typedef struct geodisk_sampler_options {
    size_t struct_size;
    uint64_t device_bytes;     /* Maximum bytes of a run on the device; 0 for no limit. */
    double submission_seconds; /* Target length of one submission; 0 for 0.02, or 0.1 on a CPU. */
    double stall_seconds;      /* A longer submission counts as hung; 0 for 120, or 600 on a CPU. */
} geodisk_sampler_options;

/* Compiles the pipelines that all domains share. `options` may be NULL. Stable. */
GEODISK_C_API geodisk_status geodisk_sampler_create(const geodisk_device *device,
                                                    const geodisk_sampler_options *options,
                                                    geodisk_sampler **sampler,
                                                    geodisk_error *error);

/* How far a run is. */
typedef struct geodisk_progress {
    size_t struct_size;
    uint32_t decided;    /* Candidates decided or in work, approximately. */
    uint32_t candidates; /* All candidates. */
    uint32_t accepted;   /* Samples so far. */
    uint32_t disks;      /* Complete disks. */
    uint64_t windows;    /* Windows of those disks. */
} geodisk_progress;

/* Is called between submissions, on the thread that samples. Returns 0 to continue; any other value
 * stops the run with GEODISK_CANCELLED. Must not use the sampler. */
typedef int32_t (*geodisk_progress_fn)(void *user, const geodisk_progress *progress);

/* Samples a domain and waits for the result. `progress` may be NULL; `user` is passed to it.
 * Stable. */
GEODISK_C_API geodisk_status geodisk_sample(geodisk_sampler *sampler, const geodisk_domain *domain,
                                            geodisk_progress_fn progress, void *user,
                                            geodisk_samples **samples, geodisk_error *error);

/* Order of samples. */
typedef int32_t geodisk_order;
enum {
    GEODISK_ORDER_DART = 0,        /* As sequential dart throwing accepts them. */
    GEODISK_ORDER_PROGRESSIVE = 1, /* In levels, coarse ones first. */
    GEODISK_ORDER_FARTHEST = 2     /* Each as far as possible from all before it. */
};

/* What is to be sampled on a surface, in one run or several: features first, levels, or runs at
 * other distances until there are as many samples as wanted. */
typedef struct geodisk_request {
    size_t struct_size;
    /* The run at one distance. With `count`, its distance is the first one to try, or 0 for
     * geodisk_distance_for_count. */
    const geodisk_surface_params *params;
    double count;         /* Not 0: find the distance for about so many samples. */
    int32_t is_exact;     /* Not 0: return exactly `count` samples. */
    geodisk_order order;
    double features;      /* Not 0: sample features first, as geodisk_domain_features finds them from
                           * this angle in degrees on. */
    double level_factor;  /* Distance of a level, divided by that of the next; 0 for 2. */
    uint32_t levels;      /* Levels of GEODISK_ORDER_PROGRESSIVE; 0 for as many as suit. */
    uint32_t keep;        /* Samples to keep of GEODISK_ORDER_FARTHEST; 0 for all. */
    /* Number of samples of each of params->class_count classes to keep, the first ones of each, which
     * is copied; NULL for all. Existing samples count, and are kept. If a class has fewer, it has
     * what the run gave. */
    const uint32_t *class_counts;
    /* Not 0: sample at vertices alone. Each is a candidate, drawn by its share of the area. */
    int32_t at_vertices;
} geodisk_request;

/* Two fields of requests that exclude each other, as geodisk/request_rules.hpp names them. */
typedef struct geodisk_rule {
    size_t struct_size;
    const char *field;
    const char *other;
    const char *reason; /* A sentence without a full stop. */
} geodisk_rule;

/* Returns the rule with this number, from 0 on. Fails with GEODISK_INVALID_ARGUMENT after the last
 * one. Its texts stay as long as the library. Stable. */
GEODISK_C_API geodisk_status geodisk_request_rule(size_t number, geodisk_rule *rule,
                                                  geodisk_error *error);

/* Samples what the request asks for, and waits for the result. `progress` may be NULL, and is called
 * for each run anew; `user` is passed to it. Fields that exclude each other are refused by name.
 * Stable. */
GEODISK_C_API geodisk_status geodisk_sample_request(geodisk_sampler *sampler,
                                                    const geodisk_mesh *mesh,
                                                    const geodisk_request *request,
                                                    geodisk_progress_fn progress, void *user,
                                                    geodisk_samples **samples,
                                                    geodisk_error *error);

/* Begins to serve a request without waiting, and copies what it refers to. Call geodisk_poll until
 * it ends. Stable. */
GEODISK_C_API geodisk_status geodisk_start_request(geodisk_sampler *sampler,
                                                   const geodisk_mesh *mesh,
                                                   const geodisk_request *request,
                                                   geodisk_error *error);

/* A request, and the mesh that it is for. */
typedef struct geodisk_mesh_request {
    size_t struct_size;
    const geodisk_mesh *mesh;
    const geodisk_request *request;
} geodisk_mesh_request;

/* Samples what `count` requests ask for, at least one, each as geodisk_sample_request does. Their runs
 * share jobs where they may, which is much faster if the sets are small. All elements of `requests`
 * have the struct_size of the first one. Writes `count` handles to `samples`; a failure of one is a
 * failure of all. Reports are of whole jobs. Stable. */
GEODISK_C_API geodisk_status geodisk_sample_requests(geodisk_sampler *sampler,
                                                     const geodisk_mesh_request *requests,
                                                     size_t count, geodisk_progress_fn progress,
                                                     void *user, geodisk_samples **samples,
                                                     geodisk_error *error);

/* Begins to serve requests without waiting, as geodisk_start_request does. geodisk_poll then takes
 * room for `count` handles. Stable. */
GEODISK_C_API geodisk_status geodisk_start_requests(geodisk_sampler *sampler,
                                                    const geodisk_mesh_request *requests,
                                                    size_t count, geodisk_error *error);

/* What is to be sampled in a box, in one run or several. */
typedef struct geodisk_box_request {
    size_t struct_size;
    /* The run at one distance. With `count`, its distance is the first one to try, or 0 for
     * geodisk_box_distance_for_count. */
    const geodisk_box_params *params;
    double count;     /* Not 0: find the distance for about so many samples. */
    int32_t is_exact; /* Not 0: return exactly `count` samples. */
} geodisk_box_request;

/* Samples what the request asks for, as geodisk_sample_request does. Stable. */
GEODISK_C_API geodisk_status geodisk_sample_box_request(geodisk_sampler *sampler,
                                                        const geodisk_box_request *request,
                                                        geodisk_progress_fn progress, void *user,
                                                        geodisk_samples **samples,
                                                        geodisk_error *error);
/* Begins to serve the request without waiting, as geodisk_start_request does. Stable. */
GEODISK_C_API geodisk_status geodisk_start_box_request(geodisk_sampler *sampler,
                                                       const geodisk_box_request *request,
                                                       geodisk_error *error);

/* Begins a run without waiting. Call geodisk_poll until it ends. Stable. */
GEODISK_C_API geodisk_status geodisk_start(geodisk_sampler *sampler, const geodisk_domain *domain,
                                           geodisk_error *error);
/* Waits for the latest submission, at most this many milliseconds. Once it has ended, submits the
 * next one. Writes the samples to `samples` when the run is complete, else NULL; those of several
 * requests as geodisk_sample_requests does. A failure ends the run. Stable. */
GEODISK_C_API geodisk_status geodisk_poll(geodisk_sampler *sampler, uint32_t milliseconds,
                                          geodisk_samples **samples, geodisk_error *error);

/* Writes how far a run begun by geodisk_start, or a search begun by geodisk_start_neighbours, is; all
 * 0 if there is none. Stable. */
GEODISK_C_API geodisk_status geodisk_sampler_progress(geodisk_sampler *sampler,
                                                      geodisk_progress *progress,
                                                      geodisk_error *error);

/* Stops the run in progress, if there is one; it ends with GEODISK_CANCELLED. This is the only
 * function of a sampler that may be called while another thread uses it. Stable. */
GEODISK_C_API void geodisk_cancel(geodisk_sampler *sampler);

/* Frees the device memory that is kept for the next run. Stable. */
GEODISK_C_API geodisk_status geodisk_sampler_trim(geodisk_sampler *sampler, geodisk_error *error);

/* Stops the run in progress, if there is one, waits for the device, and frees the sampler.
 * Stable. */
GEODISK_C_API void geodisk_sampler_release(geodisk_sampler *sampler);

/* ---- Samples ----------------------------------------------------------------------------------- */

/* Returns the number of samples. They are in dart order, so the first n of them are the set of a
 * run with stop_count n. Stable. */
GEODISK_C_API size_t geodisk_samples_count(const geodisk_samples *samples);

/* Data of a sample. Samples of a box have GEODISK_POSITION and GEODISK_RADIUS only. */
typedef int32_t geodisk_attribute;
enum {
    GEODISK_FACE = 0,        /* 1 integer: index of its triangle in the caller's mesh. */
    GEODISK_BARYCENTRIC = 1, /* 3 numbers: weights of the triangle's corners; they sum to 1. */
    GEODISK_POSITION = 2,    /* Coordinates, as many as the mesh or box has. */
    GEODISK_NORMAL = 3,      /* 3 numbers: unit normal of the triangle; 0 if it has no area. Needs
                              * a mesh in three dimensions. */
    GEODISK_RADIUS = 4,      /* 1 number: half of the minimum distance, or of that of its
                              * class, unless radii vary. */
    GEODISK_PART = 5,        /* 1 integer: index of the sample's surface. GEODISK_FACE is an index
                              * into that surface. */
    GEODISK_CLASS = 6,       /* 1 integer: class, if samples have classes. */
    /* Of geodisk_request: */
    GEODISK_FEATURE = 7,     /* 1 integer: 2 on a corner, 1 on a curve, 0 on a face, if `features`. */
    GEODISK_LEVEL = 8,       /* 1 integer: level, from 0 on, for GEODISK_ORDER_PROGRESSIVE. */
    GEODISK_COVER = 9,       /* 1 number: distance to the nearest sample before, for
                              * GEODISK_ORDER_FARTHEST; infinite for the first of a component. */
    GEODISK_ROW = 10         /* 1 integer: its place in dart order, for GEODISK_ORDER_FARTHEST. */
};

/* Returns the count of numbers per sample of an attribute; 0 if the samples lack it. Stable. */
GEODISK_C_API uint32_t geodisk_samples_width(const geodisk_samples *samples,
                                             geodisk_attribute attribute);

/* Writes an attribute of all samples to memory of the caller's, such as a mapped buffer. The
 * numbers of a sample are adjacent; `stride` is the bytes from one sample to the next, 0 if packed.
 * `capacity` is the number of samples that fit, at least all of them. `type` is GEODISK_UINT32 for
 * integers, otherwise GEODISK_FLOAT64 or GEODISK_FLOAT32. Coordinates are computed in double
 * precision. Stable. */
GEODISK_C_API geodisk_status geodisk_samples_copy(const geodisk_samples *samples,
                                                  geodisk_attribute attribute, geodisk_type type,
                                                  void *data, size_t stride, size_t capacity,
                                                  geodisk_error *error);

/* How a run went. */
typedef struct geodisk_report {
    size_t struct_size;
    uint64_t samples;
    uint32_t candidates; /* Candidates decided. */
    uint32_t batches;    /* Batches of disks. */
    uint32_t dispatches; /* Dispatches recorded. */
    uint32_t disks;      /* Geodesic disks computed. */
    uint64_t windows;    /* Windows and vertex events of all disks. */
    uint64_t device_bytes; /* Memory allocated on the device, in bytes. */
    double min_distance; /* Minimum distance of the domain, or of the first of several surfaces. */
    double guard;        /* Conflicts were tested against min_distance * (1 + guard). */
    double rho;          /* Packing density; 0 for boxes and for several surfaces. */
    double compile_seconds;
    double upload_seconds;
    double sample_seconds;
    double readback_seconds;
    uint32_t missing;   /* How many samples of stop_count are missing. */
    uint32_t existing;  /* How many samples are existing ones: the first. */
    /* Of a maximal set (geodisk_surface_params.is_maximal), else 0: */
    uint32_t maximal_rounds; /* Rounds in which darts were thrown into gaps. */
    int32_t is_certified;    /* 1 if every point is nearer to a sample than largest_gap. */
    uint64_t maximal_cells;  /* Parts of faces that were tested. */
    double largest_gap;      /* Bound on the distance from any point to the nearest sample; if radii
                              * vary, on its excess over the sum of two radii, plus min_distance. */
    /* Of a geodisk_request, else 0: */
    uint32_t tries;          /* Distances tried. */
    uint32_t levels;         /* Levels. The distance of the last one is min_distance, and that of
                              * each before it level_factor times as large. */
    double level_factor;
    uint64_t cut;            /* Samples of the run that a count left out. */
    uint64_t corners;        /* Corners on faces that take samples. */
    double feature_length;   /* Length of all curves. */
    int32_t lacks_features;  /* 1 if features were asked for, and no face that takes samples has one. */
    double cover;            /* Largest distance of a sample left out of the farthest order to the
                              * nearest one kept. */
} geodisk_report;

/* Reports how the run of these samples went. Stable. */
GEODISK_C_API geodisk_status geodisk_samples_report(const geodisk_samples *samples,
                                                    geodisk_report *report, geodisk_error *error);

/* Releases the samples. Stable. */
GEODISK_C_API void geodisk_samples_release(geodisk_samples *samples);

/* ---- Neighbours -------------------------------------------------------------------------------- */

/* Where to look for the neighbours of a source. */
typedef int32_t geodisk_neighbour_kind;
enum {
    GEODISK_AMONG_VERTICES = 0, /* Vertices of the mesh. Where vertices are joined, all of them, or
                                 * with `nearest` the lowest. */
    GEODISK_AMONG_POINTS = 1,   /* geodisk_neighbour_params.points. */
    GEODISK_AMONG_SOURCES = 2   /* The other sources. */
};

/* Which neighbours to find. Lengths are in mesh units. */
typedef struct geodisk_neighbour_params {
    size_t struct_size;
    /* Sources: points, or vertices of the mesh. NULL both for all vertices that a face uses; for
     * GEODISK_AMONG_SOURCES, for the lowest of those that are joined. */
    const geodisk_surface_point *sources;
    const uint32_t *source_vertices;
    size_t source_count;
    double within;        /* A neighbour is at most so far away, along the surface; 0 with `nearest`
                           * for any distance. */
    const double *radii;  /* Distance of each source; NULL if `within` holds for all. */
    geodisk_neighbour_kind kind;
    const geodisk_surface_point *points; /* To find, for GEODISK_AMONG_POINTS. */
    size_t point_count;
    uint32_t nearest;     /* Not 0: keep only so many of each source, the nearest ones; vertices that
                           * are joined count once. */
    uint64_t max_pairs;  /* Most pairs to find in all; 0 for 2^30. */
    /* Lowest vertex that each vertex is joined with, if the caller has joined vertices; NULL for
     * those that geodisk_mesh_create joined. */
    const uint32_t *joined;
} geodisk_neighbour_params;

/* The neighbours of sources. */
typedef struct geodisk_neighbours geodisk_neighbours;

/* Finds the neighbours of all sources and waits for the result. It is the same on every device.
 * `progress` may be NULL, and counts sources as candidates; `user` is passed to it.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_find_neighbours(geodisk_sampler *sampler,
                                                     const geodisk_mesh *mesh,
                                                     const geodisk_neighbour_params *params,
                                                     geodisk_progress_fn progress, void *user,
                                                     geodisk_neighbours **neighbours,
                                                     geodisk_error *error);

/* Begins such a search without waiting, and copies what `params` refers to. Call
 * geodisk_poll_neighbours until it ends. geodisk_cancel and geodisk_sampler_progress serve it too.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_start_neighbours(geodisk_sampler *sampler,
                                                      const geodisk_mesh *mesh,
                                                      const geodisk_neighbour_params *params,
                                                      geodisk_error *error);
/* Waits for the latest submission, at most this many milliseconds. Once it has ended, submits the
 * next one. Writes the neighbours to `neighbours` when all are found, else NULL. A failure ends the
 * search. Experimental. */
GEODISK_C_API geodisk_status geodisk_poll_neighbours(geodisk_sampler *sampler,
                                                     uint32_t milliseconds,
                                                     geodisk_neighbours **neighbours,
                                                     geodisk_error *error);

/* The arrays of neighbours, which live as long as these. The neighbours of source i are those from
 * offsets[i] up to offsets[i + 1]: by index, or with `nearest` by distance. */
typedef struct geodisk_neighbour_arrays {
    size_t struct_size;
    size_t source_count;
    size_t pair_count;
    const uint32_t *vertices;  /* Index of each source's vertex; NULL if sources are points. */
    const uint64_t *offsets;   /* One more than sources. */
    const uint32_t *indices;   /* Index of each neighbour: a vertex, point or source. */
    const float *distances;    /* Distance of each neighbour, in mesh units; 0 at the source itself. */
    double error;              /* Bound on the error of the distances, in mesh units. */
} geodisk_neighbour_arrays;

/* Points `arrays` at the neighbours found. Set struct_size first. The arrays are valid until
 * the neighbours are released. Experimental. */
GEODISK_C_API geodisk_status geodisk_neighbours_describe(const geodisk_neighbours *neighbours,
                                                         geodisk_neighbour_arrays *arrays,
                                                         geodisk_error *error);

/* Releases the neighbours. Experimental. */
GEODISK_C_API void geodisk_neighbours_release(geodisk_neighbours *neighbours);

/* ---- Cells -------------------------------------------------------------------------------------- */

/* Which cells to find. */
typedef struct geodisk_cell_params {
    size_t struct_size;
    const geodisk_surface_point *samples; /* At least one. */
    size_t sample_count;
    int32_t areas_only;    /* Not 0: find no edges and triangles. */
    uint64_t max_records; /* Maximum number of records of paths, 36 bytes each; 0 for 2^27. */
    const uint8_t *face_mask; /* A byte per face: 0 where areas count for no cell; NULL for all. */
} geodisk_cell_params;

/* The geodesic Voronoi cells of samples: what is nearer to each one than to all others. */
typedef struct geodisk_cells geodisk_cells;

/* Finds the cells of all samples and waits for the result. It is the same on every device.
 * `progress` may be NULL, and counts samples twice as candidates: their disks, then their cells;
 * `user` is passed to it. Experimental. */
GEODISK_C_API geodisk_status geodisk_find_cells(geodisk_sampler *sampler, const geodisk_mesh *mesh,
                                                const geodisk_cell_params *params,
                                                geodisk_progress_fn progress, void *user,
                                                geodisk_cells **cells, geodisk_error *error);

/* The arrays of cells, which live as long as these. */
typedef struct geodisk_cell_arrays {
    size_t struct_size;
    size_t sample_count;
    size_t edge_count;
    size_t triangle_count;
    const double *areas;       /* Area of each cell. They sum to the area of the mesh, or of the
                                * faces of the mask, minus `unreached`. */
    const uint32_t *edges;     /* Pairs of samples whose cells touch: the lower one first. */
    const uint32_t *triangles; /* Three samples for each place where their cells meet. */
    double area_error;         /* Maximum error of an area. */
    double distance_error;     /* Bound on the error of the distances, in mesh units. */
    double unreached;          /* Area of the parts of the mesh without a sample. */
    uint64_t manifold_triangles; /* Triangles whose edges have one or two triangles, and whose
                                  * corners have one fan of them. */
    int64_t euler;             /* Vertices - edges + triangles. */
    int64_t mesh_euler;        /* Euler characteristic of the mesh. */
} geodisk_cell_arrays;

/* Points `arrays` at the cells and their dual. Set struct_size first. The arrays are valid until
 * the cells are released. Experimental. */
GEODISK_C_API geodisk_status geodisk_cells_describe(const geodisk_cells *cells,
                                                    geodisk_cell_arrays *arrays,
                                                    geodisk_error *error);

/* Releases the cells. Experimental. */
GEODISK_C_API void geodisk_cells_release(geodisk_cells *cells);

/* Finds the sample nearest to any point of a mesh, from the disks of the samples. It keeps the data of
 * the mesh, which may be released, and several threads may use it at a time. */
typedef struct geodisk_nearest geodisk_nearest;

/* Computes the disks of the samples of `params`, whose `areas_only` is ignored, and waits for the
 * result. `progress` may be NULL, and counts samples as candidates; `user` is passed to it.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_nearest_create(geodisk_sampler *sampler,
                                                    const geodisk_mesh *mesh,
                                                    const geodisk_cell_params *params,
                                                    geodisk_progress_fn progress, void *user,
                                                    geodisk_nearest **nearest,
                                                    geodisk_error *error);

/* Sample that geodisk_nearest_find() gives points that no path leads to. */
#define GEODISK_NO_SAMPLE UINT32_MAX

/* Writes the nearest sample of each point, on the CPU, and its distance in mesh units. Where no path
 * leads to a sample, writes GEODISK_NO_SAMPLE and an infinite distance. Ties up to rounding go to the
 * first sample. `distances` may be NULL. The result is the same on every device. Experimental. */
GEODISK_C_API geodisk_status geodisk_nearest_find(const geodisk_nearest *nearest,
                                                  const geodisk_surface_point *points,
                                                  size_t point_count, uint32_t *samples,
                                                  float *distances, geodisk_error *error);

/* Finds the cells of the samples as geodisk_find_cells() does, from the same disks: with the dual.
 * `progress` may be NULL, counts samples twice as candidates, and begins halfway. Experimental. */
GEODISK_C_API geodisk_status geodisk_nearest_cells(const geodisk_nearest *nearest,
                                                   geodisk_progress_fn progress, void *user,
                                                   geodisk_cells **cells, geodisk_error *error);

/* Returns a bound on the error of distances, in mesh units. Experimental. */
GEODISK_C_API double geodisk_nearest_error(const geodisk_nearest *nearest);

/* Releases it. The cells found with it stay. Experimental. */
GEODISK_C_API void geodisk_nearest_release(geodisk_nearest *nearest);

/* Which samples to put in farthest-point order, and from where. */
typedef struct geodisk_farthest_params {
    size_t struct_size;
    const geodisk_surface_point *samples;
    size_t sample_count;
    uint32_t count; /* Number of samples to choose; 0 for all. */
    uint32_t start; /* Index of the first one. Not with `existing`. */
    /* Number of samples that come first as they are: the first of all. The next one is the one
     * farthest from all of these. They count towards `count`. */
    uint32_t existing;
} geodisk_farthest_params;

/* How samples came to be in farthest-point order. */
typedef struct geodisk_farthest_info {
    size_t struct_size;
    double cover;       /* Largest distance of a sample left out to the nearest one chosen; 0 if none
                         * is left out. */
    double error;       /* Distances are at most so far from exact ones, in mesh units. */
    uint32_t searches;  /* Searches on the device, each of many disks. */
} geodisk_farthest_info;

/* Puts samples of a mesh in farthest-point order and waits for the result: the first one, or
 * existing ones, then always the one whose geodesic distance to all before it is largest; of equally
 * far ones, the lower index. Writes the index of each one to `order`, and its distance to the nearest
 * one before to `distances`: infinite for existing ones, and for the first one on each part of the
 * mesh without these. Both have room for as many; `distances` and `info` may be NULL. The result is
 * the same on every device.
 * `progress` may be NULL, and counts samples as candidates; `user` is passed to it.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_farthest_order(geodisk_sampler *sampler,
                                                    const geodisk_mesh *mesh,
                                                    const geodisk_farthest_params *params,
                                                    geodisk_progress_fn progress, void *user,
                                                    uint32_t *order, float *distances,
                                                    geodisk_farthest_info *info,
                                                    geodisk_error *error);

/* ---- Geodesics --------------------------------------------------------------------------------- */

/* Distances and paths along a surface, computed on the CPU in double precision, without a device.
 * Lengths are in mesh units. */

/* From where to measure, and to what. */
typedef struct geodisk_distance_params {
    size_t struct_size;
    /* Sources: points, or vertices of the mesh. One of them. */
    const geodisk_surface_point *sources;
    const uint32_t *source_vertices;
    size_t source_count;
    const geodisk_surface_point *targets; /* Points to measure to; NULL for all vertices. */
    size_t target_count;
    int32_t each;         /* Not 0: measure from each source on its own, not from the nearest. */
    uint32_t max_threads; /* Each computes a source; 0 for 16. */
    double within;        /* What is farther away gets infinity; 0 for no limit. */
    /* Lowest vertex that each vertex is joined with, if the caller has joined vertices; NULL for
     * those that geodisk_mesh_create joined. */
    const uint32_t *joined;
} geodisk_distance_params;

/* Source of targets that no path leads to. */
#define GEODISK_NO_SOURCE UINT32_MAX

/* Writes the exact distance of each target from the nearest source to `distances`, and the index of
 * that source to `nearest`; with `each` all targets from the first source, then all from the second,
 * and so on, and `nearest` is not written. Where no path leads, writes an infinite distance and
 * GEODISK_NO_SOURCE. `nearest` may be NULL. `progress` may be NULL, and counts vertices, or with
 * `each` sources, as candidates; it is called by any thread of this call, by one at a time.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_geodesic_distances(const geodisk_mesh *mesh,
                                                        const geodisk_distance_params *params,
                                                        geodisk_progress_fn progress, void *user,
                                                        double *distances, uint32_t *nearest,
                                                        geodisk_error *error);

/* The ends of a path: points, or vertices where these are NULL. */
typedef struct geodisk_path_params {
    size_t struct_size;
    const geodisk_surface_point *from;
    const geodisk_surface_point *to;
    uint32_t from_vertex;
    uint32_t to_vertex;
} geodisk_path_params;

/* A point of a path, by the weights of its face's corners. */
typedef struct geodisk_path_point {
    uint32_t face;
    double weights[3];
} geodisk_path_point;

/* A shortest path along a surface. */
typedef struct geodisk_path geodisk_path;

/* Finds a shortest path; of several, any. Fails with GEODISK_INVALID_ARGUMENT if none leads from one
 * end to the other. Experimental. */
GEODISK_C_API geodisk_status geodisk_geodesic_path(const geodisk_mesh *mesh,
                                                   const geodisk_path_params *params,
                                                   geodisk_path **path, geodisk_error *error);

/* Returns the length of a path. Experimental. */
GEODISK_C_API double geodisk_path_length(const geodisk_path *path);

/* Returns the points of a path, `count` of them: its ends, and between them where it crosses an edge
 * or bends at a vertex. It runs straight from each to the next. They live as long as the path.
 * Experimental. */
GEODISK_C_API const geodisk_path_point *geodisk_path_points(const geodisk_path *path,
                                                            size_t *count);

/* Releases the path. Experimental. */
GEODISK_C_API void geodisk_path_release(geodisk_path *path);

/* Writes the radius of the geodesic disk around each of `params->sources` or `source_vertices` that
 * holds an area, in square mesh units, to `radii`; if the part of the mesh is smaller, the radius that
 * covers it. Areas err by about 1 in 1,000. Only these fields of `params`, and `joined` and
 * `max_threads`, are used. `progress` may be NULL, and counts sources as candidates; it is called by
 * any thread of this call, by one at a time. Experimental. */
GEODISK_C_API geodisk_status geodisk_disk_radii(const geodisk_mesh *mesh,
                                                const geodisk_distance_params *params, double area,
                                                geodisk_progress_fn progress, void *user,
                                                double *radii, geodisk_error *error);

/* Finds which faces of a mesh are seen from outside: by `share` (0 to 1; 0.02 is a good one) of the
 * rays from one of their sides. Writes a byte per face to `mask`, 1 or 0, as
 * geodisk_surface_params.face_mask takes it. Needs a mesh with three coordinates per vertex.
 * `progress` may be NULL; any thread may call it, one at a time. Experimental. */
GEODISK_C_API geodisk_status geodisk_outside_faces(const geodisk_mesh *mesh, double share,
                                                   geodisk_progress_fn progress, void *user,
                                                   uint8_t *mask, geodisk_error *error);

/* ---- Updates ----------------------------------------------------------------------------------- */

/* The samples of a surface, kept up to date while it is edited. An update decides only what the
 * edit can reach. If an edit makes an edge longer than the frame allows, or the first edge of more
 * than two faces, it decides everything in the frame of the edited surface. The samples are always
 * those of a whole run in the frame of the updater, as geodisk_domain_surface_in_frame makes it. One
 * call at a time. */
typedef struct geodisk_updater geodisk_updater;

/* Makes the updater of a surface and its samples: all of a run, the existing ones first. Everything is
 * copied. The metric is GEODISK_GEODESIC, and `params` has no darts, stop_count, classes and
 * is_maximal; the mesh has coordinates. `frame` is the one in which the samples were decided; NULL if
 * they are from a run over this mesh without another frame. Fails for a sample that is no candidate of
 * these parameters, with its index in `error->element`. Experimental. */
GEODISK_C_API geodisk_status geodisk_updater_create(const geodisk_mesh *mesh,
                                                    const geodisk_surface_params *params,
                                                    const geodisk_job_frame *frame,
                                                    const geodisk_surface_point *samples,
                                                    size_t sample_count,
                                                    geodisk_updater **updater,
                                                    geodisk_error *error);

/* The same from the samples of the surface before an edit, whose faces may have other indices. Finds
 * out what has changed: call geodisk_update with `mesh`, `params` and no changed faces next. Faces
 * correspond by their keys, or by their indices without. `frame` is the one in which the samples were
 * decided, or NULL as above. Experimental. */
GEODISK_C_API geodisk_status geodisk_updater_create_edited(const geodisk_mesh *mesh_before,
                                                           const geodisk_surface_params *params_before,
                                                           const geodisk_mesh *mesh,
                                                           const geodisk_surface_params *params,
                                                           const geodisk_job_frame *frame,
                                                           const geodisk_surface_point *samples,
                                                           size_t sample_count,
                                                           geodisk_updater **updater,
                                                           geodisk_error *error);

/* How an update went. */
typedef struct geodisk_update_info {
    size_t struct_size;
    uint32_t rounds;   /* Times a region was decided. Each one is wider than the last. */
    uint32_t faces;    /* Faces of the last region. */
    uint32_t uploaded; /* Faces that were on the device for it. */
    uint32_t removed;  /* Samples that are no longer there, existing ones aside. */
    uint32_t added;    /* Samples that are new. */
    uint32_t disks;    /* Geodesic disks computed. */
} geodisk_update_info;

/* Brings the samples up to date with the edited surface. `changed` lists the faces of which
 * anything differs: the position of a corner, its vertices, radii, key or mask; all others must be
 * as before. Faces keep their indices: to remove one, let it name a vertex twice. New ones come
 * last, and count as changed. Existing samples and points to avoid are compared with those before.
 * The seed, minimum distance and pool ratio must not change. A mesh of which only radii, mask or
 * existing samples change need not be made again. `info` may be NULL; `progress` may be NULL, and
 * `user` is passed to it. After a failure the samples are as before, and the next update includes
 * this edit. Experimental. */
GEODISK_C_API geodisk_status geodisk_update(geodisk_updater *updater, geodisk_sampler *sampler,
                                            const geodisk_mesh *mesh,
                                            const geodisk_surface_params *params,
                                            const uint32_t *changed, size_t changed_count,
                                            geodisk_progress_fn progress, void *user,
                                            geodisk_update_info *info, geodisk_error *error);

/* Makes a copy of the samples as they are, existing ones first, then in dart order.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_updater_samples(geodisk_updater *updater,
                                                     geodisk_samples **samples,
                                                     geodisk_error *error);

/* Writes the frame in which the samples were decided. Pass it with the samples to another updater.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_updater_frame(geodisk_updater *updater,
                                                   geodisk_job_frame *frame, geodisk_error *error);

/* Releases the updater. Experimental. */
GEODISK_C_API void geodisk_updater_release(geodisk_updater *updater);

/* ---- Recording --------------------------------------------------------------------------------- */

/* A run in the caller's command buffers and memory, on a borrowed device. It allocates no device
 * memory, submits nothing and waits for nothing. The samples stay on the device. Steps:
 *
 *     geodisk_job_create    plans the run
 *     geodisk_job_need      returns the size of each buffer; geodisk_job_lay_out puts all in one
 *     geodisk_job_bind      takes the caller's buffers
 *     geodisk_job_upload    writes the data to copy into them before the first commands
 *     geodisk_job_record    records the next step, first GEODISK_BEGIN. Submit it, with a copy of
 *                           the first bytes of GEODISK_CONTROL_BUFFER to memory the host can read
 *     geodisk_job_advance   returns the next step from such a copy, until GEODISK_COMPLETE
 *
 * Use a job in one thread at a time; a call from another thread returns GEODISK_BUSY. Its command
 * buffers must run one after the other, and end before the job is released. Recording changes the
 * compute pipeline, descriptor set 0 and push constants, and includes barriers among the job's
 * buffers. The caller adds barriers against other work: the first commands write by transfers, and
 * read and write in compute shaders; the last ones write by both. */
typedef struct geodisk_job geodisk_job;

/* How to plan a job. All fields may be 0. */
typedef struct geodisk_job_options {
    size_t struct_size;
    uint64_t pool_bytes; /* Maximum bytes for disks in progress; 0 for 256 MiB. */
    uint32_t stages;     /* Stages drawn at once; more take more memory. 0 chooses; 1 for darts. */
    uint32_t regrowths;  /* Times that disks may outgrow the plan before buffers are too small. */
} geodisk_job_options;

/* Plans a job and compiles the pipelines that it needs. `options` may be NULL. Does not check the
 * arithmetic of the device; geodisk_sampler_create does. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_create(const geodisk_device *device,
                                                const geodisk_domain *domain,
                                                const geodisk_job_options *options,
                                                geodisk_job **job, geodisk_error *error);

/* Buffers of a job, 0 to GEODISK_BUFFERS - 1. Callers need to know these: */
enum {
    GEODISK_POOL_BUFFER = 6,
    GEODISK_CONTROL_BUFFER = 7,
    GEODISK_SAMPLES_BUFFER = 10, /* One geodisk_sample_record per sample, points to avoid first. */
    GEODISK_ACCEPTED_BUFFER = 11,
    GEODISK_BUFFERS = 14
};

/* VkBufferUsageFlags of each buffer: storage, uniform, both texel buffers, both transfers, indirect. */
#define GEODISK_BUFFER_USAGE 0x13fu

/* Sizes of a buffer of a job. */
typedef struct geodisk_buffer_need {
    size_t struct_size;
    uint64_t bytes;        /* Minimum size; 0 if the job does not need the buffer. */
    uint64_t upload_bytes; /* First bytes that geodisk_job_upload writes. */
    uint64_t read_bytes;   /* First bytes that geodisk_job_advance reads. */
} geodisk_buffer_need;

/* Writes the sizes of a buffer. Call it after geodisk_job_create, and again when the next step is
 * GEODISK_LARGER_POOL, GEODISK_LARGER_SAMPLES or GEODISK_START_OVER. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_need(geodisk_job *job, uint32_t buffer,
                                              geodisk_buffer_need *need, geodisk_error *error);

/* A range of a VkBuffer, aligned for storage, texel and uniform buffers. */
typedef struct geodisk_buffer_range {
    uint64_t buffer;
    uint64_t offset;
    uint64_t bytes;
} geodisk_buffer_range;

/* Lays out all buffers of the job in a single VkBuffer, from `offset` on, aligned for the device.
 * Writes GEODISK_BUFFERS ranges for geodisk_job_bind to `ranges`, and their total size to `bytes`.
 * Call it with buffer 0 to get the size. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_lay_out(geodisk_job *job, uint64_t buffer, uint64_t offset,
                                                 geodisk_buffer_range *ranges, uint64_t *bytes,
                                                 geodisk_error *error);

/* Binds GEODISK_BUFFERS ranges, which must not overlap. A range is all 0 if its buffer is not
 * needed. To replace buffers by larger ones, pass the others unchanged, and copy the contents of
 * GEODISK_SAMPLES_BUFFER and GEODISK_ACCEPTED_BUFFER. No command buffer of the job may be
 * pending. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_bind(geodisk_job *job, const geodisk_buffer_range *ranges,
                                              geodisk_error *error);

/* Writes the data of a buffer to `data`; `bytes` must equal its upload_bytes. Call it for each
 * buffer with upload_bytes, after each geodisk_job_bind of all buffers. GEODISK_BEGIN fails before
 * that. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_upload(geodisk_job *job, uint32_t buffer, void *data,
                                                size_t bytes, geodisk_error *error);

/* Next step of a job. */
typedef int32_t geodisk_next;
enum {
    GEODISK_BEGIN = 0,          /* Record it: draws the first candidates, or more of them. */
    GEODISK_GO_ON = 1,          /* Record it: decides candidates. */
    GEODISK_FINISH = 2,         /* Record it: puts the samples in order. */
    GEODISK_LARGER_POOL = 3,    /* Bind a larger buffer, then record this step. */
    GEODISK_LARGER_SAMPLES = 4, /* Bind larger buffers, then record this step. */
    GEODISK_START_OVER = 5,     /* Bind and upload all buffers again, then record GEODISK_BEGIN. */
    GEODISK_COMPLETE = 6,       /* All samples are complete. */
    GEODISK_COUNT = 7,          /* Record it: counts candidates for an exact number of darts. */
    GEODISK_PAUSED = 8,         /* All candidates below geodisk_job_set_end_order are decided. */

    /* Parts of GEODISK_GO_ON to record one by one, for your own commands between them. Always record
     * all three, in this order. They are never the next step. */
    GEODISK_SELECT = 16,
    GEODISK_DETECT = 17,
    GEODISK_RESOLVE = 18
};

/* Records a step to a VkCommandBuffer, outside a render pass. `amount` is the number of rounds for
 * GEODISK_GO_ON, 0 for one; and the maximum of dispatches for GEODISK_BEGIN, GEODISK_COUNT and
 * GEODISK_FINISH, 0 for no limit. Writes to `is_last`, which may be NULL, whether the step is recorded
 * completely. If not, the next call records the rest first.
 *
 * Rounds without work are empty. GEODISK_FINISH may be recorded at any time. The samples decided so
 * far are the first ones of the set, and stay where they are. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_record(geodisk_job *job, void *command_buffer,
                                                geodisk_next what, uint32_t amount,
                                                int32_t *is_last, geodisk_error *error);

/* Answer of geodisk_job_advance. */
typedef struct geodisk_advice {
    size_t struct_size;
    geodisk_next next;
    uint32_t ready; /* Number of samples in order and final, as far as the host knows. */
    /* With GEODISK_COMPLETE, number of candidates up to the last one that takes part. 0 for a job
     * that stopped at a count: record GEODISK_COUNT, and the next copy gives the number. */
    uint64_t candidates;
} geodisk_advice;

/* Writes the next step of the job to `advice`. `control` is a copy of the first `bytes` of
 * GEODISK_CONTROL_BUFFER; `bytes` must equal its read_bytes. Copies that are too old give
 * GEODISK_GO_ON, so several frames may be in flight. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_advance(geodisk_job *job, const void *control,
                                                 size_t bytes, geodisk_advice *advice,
                                                 geodisk_error *error);

/* Restarts with another seed; record GEODISK_BEGIN next. Uploaded data stays. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_set_seed(geodisk_job *job, uint64_t seed,
                                                  geodisk_error *error);

/* No limit for geodisk_job_set_end_order. */
#define GEODISK_ALL_ORDERS 0xffffffffffffffffu

/* Decides only candidates of lower order: their stage times 2^28, plus their priority. Then
 * GEODISK_PAUSED is the next step until another order is set. Any sequence of orders gives the same
 * samples. Applies until another seed or domain is set. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_set_end_order(geodisk_job *job, uint64_t order,
                                                       geodisk_error *error);

struct geodisk_sample_record;

/* Gives the job `count` existing samples, which it copies, instead of the existing samples of its
 * domain. They precede all candidates, reject those closer than the minimum distance, and are the
 * first samples of the result, in this order.
 * Distances among them are not checked. In a box they must be samples of the same box and seed.
 * GEODISK_START_OVER comes next; buffers that are large enough may be bound again. The samples are
 * then part of the uploads, for GEODISK_SAMPLES_BUFFER. geodisk_job_bind fails for faces or weights
 * out of range. Applies to all seeds, until geodisk_job_renew. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_set_existing(geodisk_job *job,
                                                     const struct geodisk_sample_record *samples,
                                                     size_t count, geodisk_error *error);

/* Makes this a job of another domain, with the same options. GEODISK_START_OVER comes next; buffers
 * that are large enough may be bound again. Allocates nothing for a domain of the same kind. An
 * error leaves the job unchanged. Experimental. */
GEODISK_C_API geodisk_status geodisk_job_renew(geodisk_job *job, const geodisk_domain *domain,
                                               geodisk_error *error);

/* Releases the job. Experimental. */
GEODISK_C_API void geodisk_job_release(geodisk_job *job);

/* A sample in GEODISK_SAMPLES_BUFFER. The weight of the first corner is 1 - weight1 - weight2. For
 * boxes, all fields but `order` are internal. */
typedef struct geodisk_sample_record {
    uint32_t order, face;
    float weight1, weight2;
} geodisk_sample_record;

/* Computes positions and normals of the samples of a job on the device, from the caller's vertex
 * buffer. */
typedef struct geodisk_placement geodisk_placement;

/* A sample with its position. The normal has length 1, or 0 on a face without a normal. `face` is
 * an index into the surface `part`. */
typedef struct geodisk_placed_record {
    float position[3], radius;
    float normal[3];
    uint32_t face;
    float weight1, weight2;
    uint32_t part, order;
} geodisk_placed_record;

/* Buffers of a placement. Ranges are storage buffers; offsets and strides are multiples of 4
 * bytes. */
typedef struct geodisk_placement_params {
    size_t struct_size;
    geodisk_buffer_range vertices; /* Vertices, each with a position of three floats. */
    uint32_t vertex_stride;        /* Bytes from one vertex to the next; 0 for 12. */
    uint32_t position_offset;      /* Offset of the position in a vertex, in bytes. */
    int32_t has_normals;           /* Not 0: vertices have normals of three floats. 0: use the
                                    * normals of faces. */
    uint32_t normal_offset;        /* Offset of the normal in a vertex, in bytes. */
    /* Three indices per face; those of several surfaces follow each other. */
    geodisk_buffer_range indices;
    geodisk_type index_type; /* GEODISK_UINT32 or GEODISK_UINT16; 0 for GEODISK_UINT32. */
    uint32_t vertices_each;  /* Vertices per instance in `arguments`; 0 for 1. */
    /* One geodisk_placed_record per record of GEODISK_SAMPLES_BUFFER. */
    geodisk_buffer_range placed;
    /* 16 bytes: a VkDrawIndirectCommand with one instance per sample. */
    geodisk_buffer_range arguments;
} geodisk_placement_params;

/* Makes a placement for a job whose buffers are bound. Its domain must be a surface with geodesic
 * distance. Experimental. */
GEODISK_C_API geodisk_status geodisk_placement_create(geodisk_job *job,
                                                      const geodisk_placement_params *params,
                                                      geodisk_placement **placement,
                                                      geodisk_error *error);
/* Records the placement. Call it after recording GEODISK_FINISH, for the same command buffer or a
 * later one. Make another placement after GEODISK_START_OVER or GEODISK_LARGER_SAMPLES.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_placement_record(const geodisk_placement *placement,
                                                      geodisk_job *job, void *command_buffer,
                                                      geodisk_error *error);
/* Releases the placement. Experimental. */
GEODISK_C_API void geodisk_placement_release(geodisk_placement *placement);

/* ---- Samples in the frames of an engine -------------------------------------------------------- */

/* Combines a job, its memory and its placement. It allocates one buffer for everything that stays
 * on the device, records a bounded amount of work into the caller's command buffers, and keeps the
 * samples where the caller draws them. geodisk/frame_sampler.hpp says more. */
typedef struct geodisk_frame_sampler geodisk_frame_sampler;

/* How a frame sampler divides its work. All fields may be 0. */
typedef struct geodisk_frame_options {
    size_t struct_size;
    uint64_t pool_bytes;    /* Bytes for disks in progress; 0 for 16 MiB. */
    uint32_t frames;        /* Maximum of command buffers in flight, 1 to 16; 0 for 2. */
    uint32_t dispatches;    /* Maximum of dispatches per call to draw candidates; 0 for 16. */
    uint32_t rounds;        /* Rounds per call to decide candidates; 0 for 2. */
    uint32_t vertices_each; /* Vertices per instance of the indirect draw; 0 for 1. */
    /* VkPipelineStageFlags and VkAccessFlags of the caller's commands that read the samples; both 0
     * for indirect draws, compute shaders and transfers. */
    uint32_t reader_stages;
    uint32_t reader_access;
} geodisk_frame_options;

/* Makes a frame sampler of the samples that `count` requests ask for, and allocates all its memory.
 * `options` may be NULL. All elements of `requests` have the struct_size of the first one. Fails with
 * GEODISK_INVALID_ARGUMENT for a request that takes several runs, naming the field, for requests that
 * cannot share one, and for a mesh without 2 or 3 coordinates per vertex. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_create_requests(
    const geodisk_device *device, const geodisk_mesh_request *requests, size_t count,
    const geodisk_frame_options *options, geodisk_frame_sampler **frames, geodisk_error *error);

/* Makes a frame sampler of a domain of surfaces, likewise. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_create(const geodisk_device *device,
                                                          const geodisk_domain *domain,
                                                          const geodisk_frame_options *options,
                                                          geodisk_frame_sampler **frames,
                                                          geodisk_error *error);

/* Records the next part of the work to a VkCommandBuffer, outside a render pass. Writes to
 * `is_complete`, which may be NULL, whether all samples are complete. Call it only when the command
 * buffer recorded `frames` calls ago has completed. Submit in the order of the calls.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_record(geodisk_frame_sampler *frames,
                                                          void *command_buffer,
                                                          int32_t *is_complete,
                                                          geodisk_error *error);

/* Submits on the sampler's queue and waits until all samples are complete. No command buffer of
 * geodisk_frame_sampler_record may be pending. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_wait(geodisk_frame_sampler *frames,
                                                        geodisk_sampler *sampler,
                                                        geodisk_error *error);

/* Location of the samples on the device. Offsets are in bytes. */
typedef struct geodisk_frame_samples {
    size_t struct_size;
    uint64_t buffer;           /* VkBuffer; may also be bound as vertex buffer. */
    uint64_t placed_offset;    /* Offset of one geodisk_placed_record per sample, in dart order. */
    uint64_t arguments_offset; /* Offset of a VkDrawIndirectCommand with one instance per sample. */
    uint64_t device_bytes;     /* Bytes allocated on the device. */
    uint32_t capacity;         /* Number of records that fit. */
    uint32_t ready;            /* Number of samples in order and final, as far as the host knows. */
    int32_t is_complete;       /* Not 0: these are all samples. */
} geodisk_frame_samples;

/* Writes where the samples are. Valid until the next call that records, waits or sets a seed.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_describe(const geodisk_frame_sampler *frames,
                                                            geodisk_frame_samples *samples,
                                                            geodisk_error *error);

/* Restarts with another seed. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_sampler_set_seed(geodisk_frame_sampler *frames,
                                                            uint64_t seed, geodisk_error *error);

/* Frees the frame sampler. No command buffer that it recorded may be pending. Experimental. */
GEODISK_C_API void geodisk_frame_sampler_release(geodisk_frame_sampler *frames);

/* ---- Neighbours in the frames of an engine ----------------------------------------------------- */

/* Finds the neighbours that geodisk_find_neighbours finds, and leaves them in a buffer on the device.
 * It records a bounded amount of work into the caller's command buffers. geodisk/frame_neighbours.hpp
 * says more. */
typedef struct geodisk_frame_neighbours geodisk_frame_neighbours;

/* How such a search divides its work. All fields may be 0. */
typedef struct geodisk_frame_neighbour_options {
    size_t struct_size;
    uint64_t pool_bytes;   /* Bytes for disks in progress; 0 for 16 MiB. */
    uint64_t record_bytes; /* Bytes for the paths that disks find, 16 each; 0 for 16 MiB. Three times
                            * as much is allocated. */
    uint32_t frames;       /* Maximum of command buffers in flight, 1 to 16; 0 for 2. */
    uint32_t dispatches;   /* Maximum of passes per call that put neighbours in lists; 0 for 16. */
    uint32_t rounds;       /* Rounds per call that compute disks; 0 for 2. */
    /* VkPipelineStageFlags and VkAccessFlags of the caller's commands that read the lists; both 0
     * for compute shaders and transfers. */
    uint32_t reader_stages;
    uint32_t reader_access;
} geodisk_frame_neighbour_options;

/* Begins a search, allocates its memory, and copies what `params` refers to. `options` may be NULL.
 * A distance must be given: `within` or `radii`. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_neighbours_create(
    const geodisk_device *device, const geodisk_mesh *mesh, const geodisk_neighbour_params *params,
    const geodisk_frame_neighbour_options *options, geodisk_frame_neighbours **frames,
    geodisk_error *error);

/* Records the next part of the work to a VkCommandBuffer, outside a render pass. Writes to
 * `is_complete`, which may be NULL, whether all neighbours are complete. Call it only when the
 * command buffer recorded `frames` calls ago has completed. Submit in the order of the calls.
 * Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_neighbours_record(geodisk_frame_neighbours *frames,
                                                             void *command_buffer,
                                                             int32_t *is_complete,
                                                             geodisk_error *error);

/* Submits on the sampler's queue and waits until all neighbours are complete. No command buffer of
 * geodisk_frame_neighbours_record may be pending. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_neighbours_wait(geodisk_frame_neighbours *frames,
                                                           geodisk_sampler *sampler,
                                                           geodisk_error *error);

/* Location of the lists on the device. Offsets are in bytes, aligned for storage buffers. */
typedef struct geodisk_frame_neighbour_lists {
    size_t struct_size;
    uint64_t buffer;           /* VkBuffer. */
    uint64_t offsets_offset;   /* Offset of source_count + 1 words: where the neighbours of each source
                                * begin, and the end; then the number of sources that are complete. */
    uint64_t indices_offset;   /* Offset of a word per neighbour: its vertex, point or source. */
    uint64_t distances_offset; /* Offset of a float per neighbour, in mesh units. */
    uint64_t device_bytes;     /* Bytes allocated on the device. */
    double error;              /* As geodisk_neighbour_arrays.error, for the sources that are ready. */
    uint32_t source_count;
    uint32_t capacity;         /* Number of neighbours that fit. */
    uint32_t ready;            /* Sources whose neighbours are complete, as far as the host knows. */
    uint32_t pair_count;       /* Neighbours of those. */
    int32_t is_complete;       /* Not 0: these are all neighbours. */
} geodisk_frame_neighbour_lists;

/* Writes where the lists are. Valid until the next call that records or waits. Experimental. */
GEODISK_C_API geodisk_status geodisk_frame_neighbours_describe(
    const geodisk_frame_neighbours *frames, geodisk_frame_neighbour_lists *lists,
    geodisk_error *error);

/* Frees the search and its lists. No command buffer that it recorded, or that reads the lists, may be
 * pending. Experimental. */
GEODISK_C_API void geodisk_frame_neighbours_release(geodisk_frame_neighbours *frames);

#ifdef __cplusplus
}
#endif

#endif
