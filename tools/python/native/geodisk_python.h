/* Functions that the Python package needs besides geodisk/geodisk.h: meshes as the program reads
 * them, the warnings that it prints, and what it does with samples. The conventions are those of geodisk.h.
 *
 * This is no public interface. The library that has it is part of the package and changes with it.
 */
#ifndef GEODISK_PYTHON_H
#define GEODISK_PYTHON_H

#include <geodisk/geodisk.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh file, or polygons of the caller, split into triangles. */
typedef struct geodisk_source geodisk_source;

/* Source to read. Give `path`, or else the arrays of polygons. */
typedef struct geodisk_source_params {
    size_t struct_size;
    const char *path;          /* UTF-8, or builtin:NAME. */
    const double *positions;   /* `dimension` coordinates for each vertex, side by side. */
    uint32_t dimension;        /* 2 to 8. */
    size_t vertex_count;
    const uint32_t *corners;   /* Vertices of all faces, one face after another. */
    const uint64_t *face_ends; /* For each face, the end of its corners. */
    size_t face_count;
    int32_t weld;              /* As in geodisk_mesh_params. */
    double weld_distance;
    /* Names of attributes to read, as --attributes of the program takes them. */
    const char *const *attributes;
    size_t attribute_count;
    /* Reading ends with GEODISK_CANCELLED soon after this is no longer 0. May be NULL. */
    const volatile int32_t *stop;
    int32_t keep_seams;        /* As in geodisk_mesh_params. */
    const char *mesh_format;   /* "obj" and so on, or NULL for that of the extension. */
    const char *columns;       /* Columns of triangles to read: "mesh,primitive". May be NULL. */
    int32_t has_normals;       /* Not 0 to read the file's normals, for the command `record`. */
    int32_t has_uvs;           /* Not 0 to read texture coordinates, for a texture. */
    int32_t has_materials;     /* Not 0 to read materials, for the texture "auto". */
    int32_t allow_outside;     /* As --allow-outside of the program. */
} geodisk_source_params;

/* Reads a mesh. Fails with GEODISK_MESH_REJECTED for a file that cannot be read or used. */
GEODISK_C_API geodisk_status geodisk_source_read(const geodisk_source_params *params,
                                                 geodisk_source **source, geodisk_error *error);

GEODISK_C_API void geodisk_source_release(geodisk_source *source);

/* Meshes, samples and arrays in memory for a command. NULL where it needs none. */
typedef struct geodisk_task {
    size_t struct_size;
    /* A JSON object. Of samples, it has their number `count`, the names of `columns`, the entries of
     * the `header`, and the option `tolerance` for points without faces, or "". */
    const char *options;
    const double *samples;      /* Values of all columns of each sample. */
    const uint32_t *faces;      /* Of each sample. */
    const geodisk_mesh *mesh;   /* NULL for samples in a box. */
    const geodisk_mesh *to;     /* Another mesh with the same faces. */
    const geodisk_radii *radii;
    const uint8_t *face_mask;   /* As in geodisk_surface_params. */
    const geodisk_surface_point *avoid;
    const double *avoid_radii;
    const geodisk_source *source;
    const geodisk_nearest *nearest;
    /* Work ends with GEODISK_CANCELLED soon after this is no longer 0. May be NULL. */
    const volatile int32_t *stop;
    const int32_t *map_samples; /* What `bake` handed over, for each texel. */
    const float *map_distances;
    const uint32_t *map_faces;
    const char *path;           /* File to read, as the system spells it. */
} geodisk_task;

/* Takes an array that a command made. */
typedef void (*geodisk_take_fn)(const void *bytes, size_t size);

/* Runs a command of the program or of this list, and hands over what it makes:
 *   describe  `source` as JSON, with addresses of arrays that live as long as it does, 0 for none
 *   verify    the report of the program, as JSON
 *   place     faces and weights of samples on their mesh, as uint32_t and three float for each
 *   transfer  the same, then their points as double with at least three coordinates and normals as
 *             float on the mesh `to`, and the smallest distance there as double, NaN without one
 *   bake      the nearest sample of each texel of `source` as int32_t, its distance as float, the
 *             face as int32_t, and how many texels several faces cover as uint64_t
 *   save_map  nothing; writes a map of `bake` to a file
 *   record    of samples on `source`, each six numbers, weights and normals: normals as three float
 *             unless those of triangles will do, then red, green and blue as double of the texture
 *             `path`, "auto" for materials, and the quaternions x y z w of frames as double, each
 *             if asked for
 *   render    a PNG file
 *   frame_style  the style of frames that the option `text` names, as JSON: `text` as headers of
 *             files spell it, and `has_up`, true if they keep to an axis of the mesh
 *   warnings_of_mesh     what the program prints about `mesh`, made of `source` or else of arrays of
 *                        the caller, as a JSON list: open seams first
 *   warnings_of_set      the same about samples on `mesh` or in a box
 *   warnings_of_drivers  the same about drivers that the Vulkan loader leaves out
 *   explain_no_device    the `message` of a GEODISK_NO_DEVICE, with what keeps the loader from finding
 *                        a driver
 * Fails with GEODISK_INVALID_ARGUMENT for what the program refuses, in its words. */
GEODISK_C_API geodisk_status geodisk_run_command(const char *name, const geodisk_task *task,
                                                 geodisk_take_fn take, geodisk_error *error);

/* Returns geodisk.h and this header, from which Python has the types of structs and functions. */
GEODISK_C_API const char *geodisk_python_headers(void);

/* For a child of fork() whose parent has used a driver: the threads of the driver are not there, and
 * its exit handler would wait for them forever. Lets exit() end the process without the handlers that
 * were registered before, once standard streams are flushed. Does nothing where the system has no
 * such function. */
GEODISK_C_API void geodisk_skip_exit_handlers(void);

#ifdef __cplusplus
}
#endif

#endif
