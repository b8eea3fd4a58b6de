/* Samples a tetrahedron and prints the points. */
#include <stdio.h>
#include <stdlib.h>

#include <geodisk/geodisk.h>

int main(void) {
    const double positions[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const uint32_t indices[] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};

    geodisk_error error = GEODISK_INIT(geodisk_error);
    geodisk_device *device = NULL;
    geodisk_sampler *sampler = NULL;
    geodisk_mesh *mesh = NULL;
    geodisk_domain *domain = NULL;
    geodisk_samples *samples = NULL;
    double *points = NULL;
    int status = EXIT_FAILURE;

    geodisk_mesh_params shape = GEODISK_INIT(geodisk_mesh_params);
    shape.positions = positions;
    shape.vertex_count = 4;
    shape.indices = indices;
    shape.face_count = 4;

    geodisk_surface_params job = GEODISK_INIT(geodisk_surface_params);
    job.min_distance = 0.2;
    job.seed = 7;

    if (geodisk_device_open(NULL, &device, &error) ||
        geodisk_sampler_create(device, NULL, &sampler, &error) ||
        geodisk_mesh_create(&shape, &mesh, &error) ||
        geodisk_domain_surface(mesh, &job, &domain, &error) ||
        geodisk_sample(sampler, domain, NULL, NULL, &samples, &error)) {
        fprintf(stderr, "%s: %s\n", geodisk_status_name(error.status), error.message);
        goto release;
    }

    {
        const size_t count = geodisk_samples_count(samples);
        size_t i;
        points = malloc(count * 3 * sizeof *points);
        if (points == NULL ||
            geodisk_samples_copy(samples, GEODISK_POSITION, GEODISK_FLOAT64, points, 0, count,
                                 &error)) {
            goto release;
        }
        printf("%zu samples\n", count);
        for (i = 0; i < count; ++i) {
            printf("%g %g %g\n", points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        }
        status = EXIT_SUCCESS;
    }

release: /* NULL does nothing. */
    free(points);
    geodisk_samples_release(samples);
    geodisk_domain_release(domain);
    geodisk_mesh_release(mesh);
    geodisk_sampler_release(sampler);
    geodisk_device_release(device);
    return status;
}
