/* Samples a cube: in levels, each with its corners and edges first, exactly 1,000 samples in all. */
#include <geodisk/geodisk.h>
#include <stdio.h>
#include <stdlib.h>

static geodisk_error error = GEODISK_INIT(geodisk_error);
static void check(geodisk_status status) {
    if (status != GEODISK_OK) {
        fprintf(stderr, "%s: %s\n", geodisk_status_name(status), error.message);
        exit(1);
    }
}

int main(void) {
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    const uint32_t faces[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    geodisk_mesh_params shape = {
        .struct_size = sizeof shape, .positions = corners, .vertex_count = 8, .indices = faces, .face_count = 12};
    geodisk_surface_params params = GEODISK_INIT(geodisk_surface_params);
    geodisk_request request = {.struct_size = sizeof request, .params = &params, .count = 1000, .is_exact = 1,
                               .order = GEODISK_ORDER_PROGRESSIVE, .features = 30};
    geodisk_device *device;
    geodisk_sampler *sampler;
    geodisk_mesh *mesh;
    geodisk_samples *samples;
    check(geodisk_device_open(NULL, &device, &error));
    check(geodisk_sampler_create(device, NULL, &sampler, &error));
    check(geodisk_mesh_create(&shape, &mesh, &error));
    check(geodisk_sample_request(sampler, mesh, &request, NULL, NULL, &samples, &error));
    double place[1000][3];
    uint32_t feature[1000], level[1000];
    check(geodisk_samples_copy(samples, GEODISK_POSITION, GEODISK_FLOAT64, place, 0, 1000, &error));
    check(geodisk_samples_copy(samples, GEODISK_FEATURE, GEODISK_UINT32, feature, 0, 1000, &error));
    check(geodisk_samples_copy(samples, GEODISK_LEVEL, GEODISK_UINT32, level, 0, 1000, &error));
    for (size_t i = 0; i < geodisk_samples_count(samples); ++i) {
        printf("%.17g,%.17g,%.17g,%u,%u\n", place[i][0], place[i][1], place[i][2], feature[i], level[i]);
    }
    return 0;
}
